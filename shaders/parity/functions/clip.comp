#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/geometry/clip_polygon.glsl"
#include "parity/buffers.glsl"

// Inputs: four corners in shading space, and the slot of the clipped polygon to return.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(13u * i + 3u * j);
    const ConvexPolygon clipped = clip_to_horizon(make_polygon(corners, 4));
    const int slot = int(inputs[13u * i + 12u]);
    const uint at = kOutputSize * i;
    write_vec3(at, clipped.vertex[slot]);
    write_vec3(at + 3u, clipped.edge[slot]);
    write_vec3(at + 6u, clipped.normal);
}
