#include "parity/buffers.glsl"

void write_visible_normals(int at, const GgxVisibleNormals normals, vec2 u, vec3 wi) {
    write_vec3(at, ggx_visible_normals_sample(normals, u));
    results[at + 3] = ggx_visible_normals_pdf(normals, wi);
    vec2 inverse = ggx_visible_normals_invert(normals, wi);
    // A turn and none are the same.
    results[at + 4] = abs(inverse.x - 0.5);
    results[at + 5] = inverse.y;
}

// Inputs: wo, alpha, two random numbers and wi.
void compute(uint i) {
    uint begin = 9u * i;
    vec3 wo = input_vec3(begin);
    float alpha = input_at(begin + 3u);
    vec2 u = vec2(input_at(begin + 4u), input_at(begin + 5u));
    vec3 wi = input_vec3(begin + 6u);
    write_visible_normals(0, ggx_visible_normals_prepare(wo, alpha), u, wi);
    write_visible_normals(6, ggx_bounded_visible_normals_prepare(wo, alpha), u, wi);
}
