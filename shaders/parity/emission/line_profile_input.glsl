// Profiles of lines and tubes among the inputs, and what samples of these lights return.
#include "parity/buffers.glsl"

layout(set = 0, binding = 2, std430) readonly buffer Profiles { uint words[]; };
uint line_profile_word(uint at) { return words[at]; }

// What the sample of a light returns besides the sample: the layout of nusselt::parity::EmissionOutputs.
struct AlongLine {
    float at, place;
    float unshadowed;
    float pdf;
    vec2 inverse;
    float measure;
};

void write_along(uint i, vec3 wi, float pdf, const AlongLine along) {
    const uint at = kOutputSize * i;
    write_vec3(at, wi);
    outputs[at + 3u] = pdf;
    outputs[at + 4u] = below_one(along.at);
    outputs[at + 5u] = 0.0;
    outputs[at + 6u] = along.place;
    outputs[at + 7u] = along.unshadowed;
    outputs[at + 8u] = along.pdf;
    outputs[at + 9u] = along.inverse.x;
    outputs[at + 10u] = along.inverse.y;
    outputs[at + 11u] = along.measure;
}
