// Runs a technique for polygons that returns directions alone.
#include "bench/polygon_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    return technique_prepare(column_polygon(index, sum));
}

LightSample sample_of(const Technique technique, inout uint state) {
    const float u = next_random(state);
    return LightSample(technique_direction(technique, vec2(u, next_random(state))), 0.0, vec3(0.0));
}

#include "bench/run.glsl"
