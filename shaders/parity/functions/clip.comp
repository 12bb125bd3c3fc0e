#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/geometry/clip_polygon.glsl"
#include "parity/buffers.glsl"

// Inputs: four corners in shading space, and the slot of the clipped polygon to return.
void compute(uint i) {
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(13u * i + 3u * j);
    ConvexPolygon clipped = clip_to_horizon(make_polygon(corners, 4));
    int slot = int(input_at(13u * i + 12u));
    write_vec3(0, clipped.vertex[slot]);
    write_vec3(3, clipped.edge[slot]);
    write_vec3(6, clipped.normal);
}
