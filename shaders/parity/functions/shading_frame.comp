#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/ltc/ltc.glsl"
#include "parity/buffers.glsl"

// Inputs: a unit normal and a unit direction.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const Frame frame = shading_frame(input_vec3(6u * i), input_vec3(6u * i + 3u));
    write_vec3(kOutputSize * i, frame.t);
    write_vec3(kOutputSize * i + 3u, frame.b);
    write_vec3(kOutputSize * i + 6u, frame.n);
}
