#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/core/trig.glsl"
#include "parity/buffers.glsl"

// Inputs: x and y of a point, an angle of at most half a turn, a number of at most one.
void compute(uint i) {
    float angle = input_at(4u * i + 2u);
    SinCos half_turn = sincos_half_turn(angle);
    SinCos quarter_turn = sincos_quarter_turn(0.5 * angle);
    results[0] = atan2_positive(input_at(4u * i + 1u), input_at(4u * i));
    results[1] = half_turn.sine;
    results[2] = half_turn.cosine;
    results[3] = quarter_turn.sine;
    results[4] = quarter_turn.cosine;
    results[5] = angle_minus_sine(input_at(4u * i + 3u));
    results[6] = one_minus_atan_ratio(input_at(4u * i + 3u));
}
