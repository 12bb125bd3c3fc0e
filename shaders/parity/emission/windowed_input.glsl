// Lights whose radiance depends on the direction among the inputs, and what samples of them return.
#include "parity/buffers.glsl"

layout(set = 0, binding = 2, std430) readonly buffer Lights { uint words[]; };
uint windowed_light_word(uint at) { return words[at]; }

// The first word of the light, the shading point, a Frame<float> of C++, and two random numbers.
const uint kWindowedSize = 15u;

uint input_light(uint begin) { return uint(inputs[begin]); }
WindowPlane input_plane(uint begin) {
    return to_shading_space(
        windowed_light_plane(input_light(begin)), input_vec3(begin + 1u),
        Frame(input_vec3(begin + 4u), input_vec3(begin + 7u), input_vec3(begin + 10u)));
}
vec2 input_random(uint begin) { return vec2(inputs[begin + 13u], inputs[begin + 14u]); }

// The layout of nusselt::parity::EmissionOutputs.
void write_windowed(uint i, const TexturedSample s, const WindowedCells cells, const WindowPlane plane, float pdf,
                    vec2 inverse,
                    float measure) {
    const uint at = kOutputSize * i;
    const float along = dot(plane.frame.n, plane.corner) / dot(plane.frame.n, s.wi);
    write_vec3(at, s.wi);
    outputs[at + 3u] = s.pdf;
    outputs[at + 4u] = s.at.x;
    outputs[at + 5u] = s.at.y;
    outputs[at + 6u] = s.pdf > 0.0 ? nusselt_length(s.p - along * s.wi) : 0.0;
    outputs[at + 7u] = windowed_cells_unshadowed(cells).y;
    outputs[at + 8u] = pdf;
    outputs[at + 9u] = inverse.x;
    outputs[at + 10u] = inverse.y;
    outputs[at + 11u] = measure;
}
