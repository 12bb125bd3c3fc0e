// A technique of practically no cost: what remains is loading, looping and storing.
#include "nusselt/core/light_sample.glsl"
#include "nusselt/geometry/line_segment.glsl"

struct BaselineLine {
    vec3 s;
};

BaselineLine baseline_line_prepare(const LineSegment light) { return BaselineLine(light.s); }

LightSample baseline_line_sample(const BaselineLine self, float u) { return LightSample(self.s, u, self.s); }
