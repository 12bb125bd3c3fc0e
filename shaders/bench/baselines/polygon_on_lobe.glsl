// A technique of practically no cost; all that is loaded of the lobe counts elsewhere.
#include "bench/baselines/polygon.glsl"
#include "nusselt/ltc/ltc.glsl"

BaselinePolygon baseline_polygon_on_lobe_prepare(const ConvexPolygon light, const Ltc lobe) {
    return baseline_polygon_prepare(light);
}

LightSample baseline_polygon_on_lobe_sample(const BaselinePolygon self, vec2 u) {
    return baseline_polygon_sample(self, u);
}
