#version 450
#extension GL_GOOGLE_include_directive : require
#define NUSSELT_MAX_VERTICES 5 // four, clipped twice
#include "interface/fused_fma.h"
#include "nusselt/ltc/polygon_shading.glsl"
#include "parity/lobe_input.glsl"

// Inputs: four corners in shading space and a lobe.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (12u + kLobeSize) * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    const ConvexPolygon light = make_polygon(corners, 4);
    const Ltc ltc = input_lobe(begin + 12u);
    const ConvexPolygon image = to_cosine_space(with_unit_extent(light), ltc);
    const uint at = kOutputSize * i;
    outputs[at] = diffuse_integral(light);
    outputs[at + 1u] = lobe_integral(light, ltc);
    outputs[at + 2u] = clipped_lobe_integral(light, ltc);
    write_vec3(at + 3u, image.vertex[2]);
    write_vec3(at + 6u, image.edge[1]);
    write_vec3(at + 9u, image.normal);
}
