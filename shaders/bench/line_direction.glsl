// Runs a technique for lines that returns directions alone.
#include "bench/line_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    return technique_prepare(column_line(index, sum));
}

LightSample sample_of(const Technique technique, inout uint state) {
    return LightSample(technique_direction(technique, next_random(state)), 0.0, vec3(0.0));
}

#include "bench/run.glsl"
