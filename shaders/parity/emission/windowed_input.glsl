// Lights whose radiance depends on the direction among the inputs, and what samples of them return.
#include "parity/words.glsl"

uint windowed_light_word(uint at) { return word_at(at); }

// The first word of the light, the shading point, a Frame<float> of C++, and two random numbers.
const uint kWindowedSize = 15u;

uint input_light(uint begin) { return uint(input_at(begin)); }
WindowPlane input_plane(uint begin) {
    return to_shading_space(
        windowed_light_plane(input_light(begin)), input_vec3(begin + 1u),
        Frame(input_vec3(begin + 4u), input_vec3(begin + 7u), input_vec3(begin + 10u)));
}
vec2 input_random(uint begin) { return vec2(input_at(begin + 13u), input_at(begin + 14u)); }

// The layout of nusselt::parity::EmissionOutputs.
void write_windowed(const TexturedSample s, const WindowedCells cells, const WindowPlane plane, float pdf, vec2 inverse,
                    float measure) {
    float along = dot(plane.frame.n, plane.corner) / dot(plane.frame.n, s.wi);
    write_vec3(0, s.wi);
    results[3] = s.pdf;
    results[4] = s.at.x;
    results[5] = s.at.y;
    results[6] = s.pdf > 0.0 ? nusselt_length(s.p - along * s.wi) : 0.0;
    results[7] = windowed_cells_unshadowed(cells).y;
    results[8] = pdf;
    results[9] = inverse.x;
    results[10] = inverse.y;
    results[11] = measure;
}
