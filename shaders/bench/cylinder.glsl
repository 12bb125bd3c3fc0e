// Runs a technique for cylinders.
#include "bench/cylinder_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    return technique_prepare(column_cylinder(index, sum));
}

#include "bench/pair_sample.glsl"
#include "bench/run.glsl"
