// Runs a technique for polygons.
#include "bench/polygon_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    return technique_prepare(column_polygon(index, sum));
}

#include "bench/pair_sample.glsl"
#include "bench/run.glsl"
