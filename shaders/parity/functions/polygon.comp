#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/geometry/polygon_measures.glsl"
#include "parity/buffers.glsl"

// Inputs: four corners in world space, the shading point and its unit normal.
void compute(uint i) {
    uint begin = 18u * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    Frame frame = frame_from_normal(input_vec3(begin + 15u));
    ConvexPolygon light = to_shading_space(make_polygon(corners, 4), input_vec3(begin + 12u), frame);
    results[0] = area(light);
    results[1] = solid_angle(light);
    results[2] = projected_solid_angle(light);
    write_vec3(3, light.vertex[2]);
    write_vec3(6, light.edge[1]);
    write_vec3(9, light.normal);
}
