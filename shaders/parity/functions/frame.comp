#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/core/frame.glsl"
#include "parity/buffers.glsl"

// Inputs: a unit normal and a vector.
void compute(uint i) {
    Frame frame = frame_from_normal(input_vec3(6u * i));
    vec3 v = input_vec3(6u * i + 3u);
    write_vec3(0, frame.t);
    write_vec3(3, frame.b);
    write_vec3(6, frame_to_local(frame, v));
    write_vec3(9, frame_to_world(frame, v));
}
