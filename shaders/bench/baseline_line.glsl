// A technique of practically no cost that reads all of a light: what remains is loading, looping and storing.
#include "nusselt/core/light_sample.glsl"
#include "nusselt/geometry/line_segment.glsl"

struct BaselineLine {
    vec3 sum;
};

BaselineLine baseline_line_prepare(LineSegment light) { return BaselineLine(light.p0 + light.length * light.s); }

LightSample baseline_line_sample(BaselineLine self, float u) { return LightSample(self.sum, u, self.sum); }
