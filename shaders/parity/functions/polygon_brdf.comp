#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/sampling/polygon_brdf.glsl"
#include "parity/buffers.glsl"

// Inputs: four corners in shading space, wo, alpha, two random numbers and wi.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 21u * i;
    vec3 corners[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < 4u; ++j) corners[j] = input_vec3(begin + 3u * j);
    const GgxVisibleNormals lobe = ggx_visible_normals_prepare(input_vec3(begin + 12u), inputs[begin + 15u]);
    const PolygonBrdf technique = polygon_brdf_prepare(make_polygon(corners, 4), lobe);
    const LightSample s = polygon_brdf_sample(technique, vec2(inputs[begin + 16u], inputs[begin + 17u]));
    const uint at = kOutputSize * i;
    write_vec3(at, s.wi);
    outputs[at + 3u] = s.pdf;
    // The point means nothing where the light is missed.
    write_vec3(at + 4u, s.pdf > 0.0 ? s.p : vec3(0.0));
    outputs[at + 7u] = polygon_brdf_pdf(technique, input_vec3(begin + 18u));
}
