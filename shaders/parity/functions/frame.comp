#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/core/frame.glsl"
#include "parity/buffers.glsl"

// Inputs: a unit normal and a vector.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const Frame frame = frame_from_normal(input_vec3(6u * i));
    const vec3 v = input_vec3(6u * i + 3u);
    write_vec3(kOutputSize * i, frame.t);
    write_vec3(kOutputSize * i + 3u, frame.b);
    write_vec3(kOutputSize * i + 6u, frame_to_local(frame, v));
    write_vec3(kOutputSize * i + 9u, frame_to_world(frame, v));
}
