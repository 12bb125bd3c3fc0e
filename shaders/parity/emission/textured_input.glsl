// Lights with textures among the inputs, and what samples of them return.
#include "parity/words.glsl"

uint textured_light_word(uint at) { return word_at(at); }

// A TexturePlane<float> of C++, the first word of the light, and two random numbers.
const uint kTexturedSize = 15u;

TexturePlane input_plane(uint begin) {
    return TexturePlane(input_vec3(begin), input_vec3(begin + 3u), input_vec3(begin + 6u), input_vec3(begin + 9u));
}
uint input_light(uint begin) { return uint(input_at(begin + 12u)); }
vec2 input_random(uint begin) { return vec2(input_at(begin + 13u), input_at(begin + 14u)); }

// The layout of nusselt::parity::EmissionOutputs.
void write_textured(const TexturedSample s, const TexturedCells cells, const TexturePlane plane, float pdf,
                    vec2 inverse, float measure) {
    write_vec3(0, s.wi);
    results[3] = s.pdf;
    results[4] = s.at.x;
    results[5] = s.at.y;
    results[6] = nusselt_length(s.p - texture_plane_point_at(plane, s.at));
    results[7] = textured_cells_unshadowed(cells).y;
    results[8] = pdf;
    results[9] = inverse.x;
    results[10] = inverse.y;
    results[11] = measure;
}
