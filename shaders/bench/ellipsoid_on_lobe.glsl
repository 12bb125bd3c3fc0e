// Runs a technique for ellipsoids on lobes.
#include "bench/ellipsoid_columns.glsl"
#include "bench/lobe_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    const Ellipsoid light = column_ellipsoid(index, sum);
    return technique_prepare(light, column_lobe(kEllipsoidColumns, index, sum));
}

#include "bench/pair_sample.glsl"
#include "bench/run.glsl"
