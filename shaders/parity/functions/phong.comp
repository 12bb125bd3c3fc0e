#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/bsdf/phong.glsl"
#include "parity/buffers.glsl"

// Inputs: wo, wi, albedo, exponent and an angle up to pi / 2.
void compute(uint i) {
    float exponent = input_at(11u * i + 9u);
    Phong phong = phong_prepare(input_vec3(11u * i), input_vec3(11u * i + 6u), exponent);
    float logarithm = negative_log_of_cosine(sincos_quarter_turn(input_at(11u * i + 10u)));
    write_vec3(0, phong_eval(phong, input_vec3(11u * i + 3u)));
    results[3] = phong_alpha(exponent);
    results[4] = logarithm;
    results[5] = exp_of_negative(logarithm);
}
