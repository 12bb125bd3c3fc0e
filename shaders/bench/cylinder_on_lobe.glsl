// Runs a technique for cylinders on lobes.
#include "bench/cylinder_columns.glsl"
#include "bench/lobe_columns.glsl"

Technique prepared(uint index, inout vec4 sum) {
    const Cylinder light = column_cylinder(index, sum);
    return technique_prepare(light, column_lobe(kCylinderColumns, index, sum));
}

#include "bench/pair_sample.glsl"
#include "bench/run.glsl"
