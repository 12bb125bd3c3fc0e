// A technique of practically no cost: what remains is loading, looping and storing.
#include "nusselt/cones/round_lights.glsl"
#include "nusselt/core/light_sample.glsl"

struct BaselineEllipse {
    vec3 center;
};

BaselineEllipse baseline_ellipse_prepare(const Ellipse light) { return BaselineEllipse(light.center); }

LightSample baseline_ellipse_sample(const BaselineEllipse self, vec2 u) {
    return LightSample(self.center, u.x + u.y, self.center);
}
