#version 450
#extension GL_GOOGLE_include_directive : require
#define NUSSELT_MAX_VERTICES 5 // four, clipped twice
#include "interface/fused_fma.h"
#include "nusselt/ltc/polygon_shading.glsl"
#include "parity/lobe_input.glsl"

// Inputs: four corners in shading space and a lobe.
void compute(uint i) {
    uint begin = (12u + kLobeSize) * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    ConvexPolygon light = make_polygon(corners, 4);
    Ltc ltc = input_lobe(begin + 12u);
    ConvexPolygon image = to_cosine_space(with_unit_extent(light), ltc);
    results[0] = diffuse_integral(light);
    results[1] = lobe_integral(light, ltc);
    results[2] = clipped_lobe_integral(light, ltc);
    write_vec3(3, image.vertex[2]);
    write_vec3(6, image.edge[1]);
    write_vec3(9, image.normal);
}
