// A technique of practically no cost; all that is loaded of the lobe counts elsewhere.
#include "bench/baselines/ellipsoid.glsl"
#include "nusselt/ltc/ltc.glsl"

BaselineEllipsoid baseline_ellipsoid_on_lobe_prepare(const Ellipsoid light, const Ltc lobe) {
    return baseline_ellipsoid_prepare(light);
}

LightSample baseline_ellipsoid_on_lobe_sample(const BaselineEllipsoid self, vec2 u) {
    return baseline_ellipsoid_sample(self, u);
}
