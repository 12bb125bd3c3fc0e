// A technique of practically no cost; all that is loaded of the lobe counts elsewhere.
#include "bench/baselines/line.glsl"
#include "nusselt/ltc/ltc.glsl"

BaselineLine baseline_line_on_lobe_prepare(const LineSegment light, const Ltc lobe) {
    return baseline_line_prepare(light);
}

LightSample baseline_line_on_lobe_sample(const BaselineLine self, float u) {
    return baseline_line_sample(self, u);
}
