// Runs a technique for lines on lobes.
#include "bench/line_columns.glsl"
#include "bench/lobe_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    const LineSegment light = column_line(index, sum);
    return technique_prepare(light, column_lobe(kLineColumns, index, sum));
}

LightSample sample_of(const Technique technique, inout uint state) {
    return technique_sample(technique, next_random(state));
}

#include "bench/run.glsl"
