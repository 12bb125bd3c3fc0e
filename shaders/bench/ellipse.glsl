// Runs a technique for ellipses.
#include "bench/ellipsoid_columns.glsl"

Technique prepared(uint index, inout vec4 sum) { return technique_prepare(column_ellipse(index, sum)); }

#include "bench/pair_sample.glsl"
#include "bench/run.glsl"
