#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/sampling/polygon_brdf.glsl"
#include "parity/buffers.glsl"

// Inputs: four corners in shading space, wo, alpha, two random numbers and wi.
void compute(uint i) {
    uint begin = 21u * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    GgxVisibleNormals lobe = ggx_visible_normals_prepare(input_vec3(begin + 12u), input_at(begin + 15u));
    PolygonBrdf technique = polygon_brdf_prepare(make_polygon(corners, 4), lobe);
    LightSample s = polygon_brdf_sample(technique, vec2(input_at(begin + 16u), input_at(begin + 17u)));
    write_vec3(0, s.wi);
    results[3] = s.pdf;
    // The point means nothing where the light is missed.
    write_vec3(4, s.pdf > 0.0 ? s.p : vec3(0.0));
    results[7] = polygon_brdf_pdf(technique, input_vec3(begin + 18u));
}
