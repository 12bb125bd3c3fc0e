#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/geometry/polygon_measures.glsl"
#include "parity/buffers.glsl"

// Inputs: four corners in world space, the shading point and its unit normal.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 18u * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    const Frame frame = frame_from_normal(input_vec3(begin + 15u));
    const ConvexPolygon light = to_shading_space(make_polygon(corners, 4), input_vec3(begin + 12u), frame);
    const uint at = kOutputSize * i;
    outputs[at] = area(light);
    outputs[at + 1u] = solid_angle(light);
    outputs[at + 2u] = projected_solid_angle(light);
    write_vec3(at + 3u, light.vertex[2]);
    write_vec3(at + 6u, light.edge[1]);
    write_vec3(at + 9u, light.normal);
}
