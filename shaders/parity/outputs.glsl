// The results of the twins of a technique for each light. Included by the entry points after the technique.
#include "parity/buffers.glsl"

// The layout of nusselt::parity::DeviceOutputs.
void write_outputs(uint i, const LightSample s, float pdf, vec2 inverse, float measure) {
    uint at = kOutputSize * i;
    write_vec3(at, s.wi);
    outputs[at + 3u] = s.pdf;
    write_vec3(at + 4u, s.p);
    outputs[at + 7u] = pdf;
    outputs[at + 8u] = inverse.x;
    outputs[at + 9u] = inverse.y;
    outputs[at + 10u] = measure;
    outputs[at + 11u] = 0.0;
}
