#include "parity/buffers.glsl"

void write_visible_normals(uint at, const GgxVisibleNormals normals, vec2 u, vec3 wi) {
    write_vec3(at, ggx_visible_normals_sample(normals, u));
    outputs[at + 3u] = ggx_visible_normals_pdf(normals, wi);
    const vec2 inverse = ggx_visible_normals_invert(normals, wi);
    // A turn and none are the same.
    outputs[at + 4u] = abs(inverse.x - 0.5);
    outputs[at + 5u] = inverse.y;
}

// Inputs: wo, alpha, two random numbers and wi.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = 9u * i;
    const vec3 wo = input_vec3(begin);
    const float alpha = inputs[begin + 3u];
    const vec2 u = vec2(inputs[begin + 4u], inputs[begin + 5u]);
    const vec3 wi = input_vec3(begin + 6u);
    const uint at = kOutputSize * i;
    write_visible_normals(at, ggx_visible_normals_prepare(wo, alpha), u, wi);
    write_visible_normals(at + 6u, ggx_bounded_visible_normals_prepare(wo, alpha), u, wi);
}
