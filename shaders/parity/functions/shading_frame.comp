#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/ltc/ltc.glsl"
#include "parity/buffers.glsl"

// Inputs: a unit normal and a unit direction.
void compute(uint i) {
    Frame frame = shading_frame(input_vec3(6u * i), input_vec3(6u * i + 3u));
    write_vec3(0, frame.t);
    write_vec3(3, frame.b);
    write_vec3(6, frame.n);
}
