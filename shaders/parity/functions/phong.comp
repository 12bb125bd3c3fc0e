#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/bsdf/phong.glsl"
#include "parity/buffers.glsl"

// Inputs: wo, wi, albedo, exponent and an angle up to pi / 2.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const float exponent = inputs[11u * i + 9u];
    const Phong phong = phong_prepare(input_vec3(11u * i), input_vec3(11u * i + 6u), exponent);
    const float logarithm = negative_log_of_cosine(sincos_quarter_turn(inputs[11u * i + 10u]));
    write_vec3(kOutputSize * i, phong_eval(phong, input_vec3(11u * i + 3u)));
    outputs[kOutputSize * i + 3u] = phong_alpha(exponent);
    outputs[kOutputSize * i + 4u] = logarithm;
    outputs[kOutputSize * i + 5u] = exp_of_negative(logarithm);
}
