// The results of the twins of a technique for each light. Included by the entry points after the technique.
#include "parity/buffers.glsl"

// The layout of nusselt::parity::DeviceOutputs.
void write_outputs(const LightSample s, float pdf, vec2 inverse, float measure) {
    write_vec3(0, s.wi);
    results[3] = s.pdf;
    write_vec3(4, s.p);
    results[7] = pdf;
    results[8] = inverse.x;
    results[9] = inverse.y;
    results[10] = measure;
    results[11] = 0.0;
}
