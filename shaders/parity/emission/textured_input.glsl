// Lights with textures among the inputs, and what samples of them return.
#include "parity/buffers.glsl"

layout(set = 0, binding = 2, std430) readonly buffer Lights { uint words[]; };
uint textured_light_word(uint at) { return words[at]; }

// A TexturePlane<float> of C++, the first word of the light, and two random numbers.
const uint kTexturedSize = 15u;

TexturePlane input_plane(uint begin) {
    return TexturePlane(input_vec3(begin), input_vec3(begin + 3u), input_vec3(begin + 6u), input_vec3(begin + 9u));
}
uint input_light(uint begin) { return uint(inputs[begin + 12u]); }
vec2 input_random(uint begin) { return vec2(inputs[begin + 13u], inputs[begin + 14u]); }

// The layout of nusselt::parity::EmissionOutputs.
void write_textured(uint i, const TexturedSample s, const TexturedCells cells, const TexturePlane plane, float pdf,
                    vec2 inverse,
                    float measure) {
    const uint at = kOutputSize * i;
    write_vec3(at, s.wi);
    outputs[at + 3u] = s.pdf;
    outputs[at + 4u] = s.at.x;
    outputs[at + 5u] = s.at.y;
    outputs[at + 6u] = nusselt_length(s.p - texture_plane_point_at(plane, s.at));
    outputs[at + 7u] = textured_cells_unshadowed(cells).y;
    outputs[at + 8u] = pdf;
    outputs[at + 9u] = inverse.x;
    outputs[at + 10u] = inverse.y;
    outputs[at + 11u] = measure;
}
