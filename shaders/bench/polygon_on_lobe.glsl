// Runs a technique for polygons on lobes.
#include "bench/polygon_columns.glsl"
#include "bench/lobe_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    const ConvexPolygon light = column_polygon(index, sum);
    return technique_prepare(light, column_lobe(kPolygonColumns, index, sum));
}

#include "bench/pair_sample.glsl"
#include "bench/run.glsl"
