// A technique of practically no cost; all that is loaded of the lobe counts elsewhere.
#include "bench/baselines/ellipse.glsl"
#include "nusselt/ltc/ltc.glsl"

BaselineEllipse baseline_ellipse_on_lobe_prepare(const Ellipse light, const Ltc lobe) {
    return baseline_ellipse_prepare(light);
}

LightSample baseline_ellipse_on_lobe_sample(const BaselineEllipse self, vec2 u) {
    return baseline_ellipse_sample(self, u);
}
