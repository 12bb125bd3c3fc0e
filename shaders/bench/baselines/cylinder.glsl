// A technique of practically no cost: what remains is loading, looping and storing.
#include "nusselt/core/light_sample.glsl"
#include "nusselt/geometry/cylinder.glsl"

struct BaselineCylinder {
    vec3 s;
};

BaselineCylinder baseline_cylinder_prepare(const Cylinder light) { return BaselineCylinder(light.axis.s); }

LightSample baseline_cylinder_sample(const BaselineCylinder self, vec2 u) {
    return LightSample(self.s, u.x + u.y, self.s);
}
