// Runs a technique for lines.
#include "bench/line_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    return technique_prepare(column_line(index, sum));
}

LightSample sample_of(const Technique technique, inout uint state) {
    return technique_sample(technique, next_random(state));
}

#include "bench/run.glsl"
