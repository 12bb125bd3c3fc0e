// Environments among the inputs, and what samples of them return.
#include "parity/buffers.glsl"

// The texels of a map stand before its words.
layout(set = 0, binding = 2, std430) readonly buffer Maps { uint words[]; };
uint environment_map_word(uint at) { return words[at]; }
vec3 environment_map_texel(uint map, ivec2 at) {
    const int size = environment_map_size(map);
    const uint begin = map - 3u * uint(size * (size - at.y) - at.x);
    return uintBitsToFloat(uvec3(words[begin], words[begin + 1u], words[begin + 2u]));
}

// The first word of a map, a Frame<float> of C++, and two random numbers.
const uint kEnvironmentSize = 12u;

uint input_map(uint begin) { return uint(inputs[begin]); }
Frame input_frame(uint begin) {
    return Frame(input_vec3(begin + 1u), input_vec3(begin + 4u), input_vec3(begin + 7u));
}
vec2 input_random(uint begin) { return vec2(inputs[begin + 10u], inputs[begin + 11u]); }

// The layout of nusselt::parity::EmissionOutputs.
void write_environment(uint i, const TexturedSample s, const EnvironmentCells cells, float pdf, vec2 inverse,
                       float measure) {
    const uint at = kOutputSize * i;
    write_vec3(at, s.p);
    outputs[at + 3u] = s.pdf;
    outputs[at + 4u] = s.at.x;
    outputs[at + 5u] = s.at.y;
    outputs[at + 6u] = environment_map_lookup(cells.map, s.at).y;
    outputs[at + 7u] = cells.unshadowed.y;
    outputs[at + 8u] = pdf;
    outputs[at + 9u] = inverse.x;
    outputs[at + 10u] = inverse.y;
    outputs[at + 11u] = measure;
}
