// A technique of practically no cost: what remains is loading, looping and storing.
#include "nusselt/cones/round_lights.glsl"
#include "nusselt/core/light_sample.glsl"

struct BaselineEllipsoid {
    vec3 center;
};

BaselineEllipsoid baseline_ellipsoid_prepare(const Ellipsoid light) { return BaselineEllipsoid(light.center); }

LightSample baseline_ellipsoid_sample(const BaselineEllipsoid self, vec2 u) {
    return LightSample(self.center, u.x + u.y, self.center);
}
