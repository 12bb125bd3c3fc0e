// Environments among the inputs, and what samples of them return.
#include "parity/words.glsl"

// The texels of a map stand before its words.
uint environment_map_word(uint at) { return word_at(at); }
vec3 environment_map_texel(uint map, ivec2 at) {
    int size = environment_map_size(map);
    uint begin = map - 3u * uint(size * (size - at.y) - at.x);
    return uintBitsToFloat(uvec3(word_at(begin), word_at(begin + 1u), word_at(begin + 2u)));
}

// The first word of a map, a Frame<float> of C++, and two random numbers.
const uint kEnvironmentSize = 12u;

uint input_map(uint begin) { return uint(input_at(begin)); }
Frame input_frame(uint begin) {
    return Frame(input_vec3(begin + 1u), input_vec3(begin + 4u), input_vec3(begin + 7u));
}
vec2 input_random(uint begin) { return vec2(input_at(begin + 10u), input_at(begin + 11u)); }

// The layout of nusselt::parity::EmissionOutputs.
void write_environment(const TexturedSample s, const EnvironmentCells cells, float pdf, vec2 inverse, float measure) {
    write_vec3(0, s.p);
    results[3] = s.pdf;
    results[4] = s.at.x;
    results[5] = s.at.y;
    results[6] = environment_map_lookup(cells.map, s.at).y;
    results[7] = cells.unshadowed.y;
    results[8] = pdf;
    results[9] = inverse.x;
    results[10] = inverse.y;
    results[11] = measure;
}
