#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/core/trig.glsl"
#include "parity/buffers.glsl"

// Inputs: x and y of a point, an angle of at most half a turn, a number of at most one.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const float angle = inputs[4u * i + 2u];
    const SinCos half_turn = sincos_half_turn(angle);
    const SinCos quarter_turn = sincos_quarter_turn(0.5 * angle);
    const uint at = kOutputSize * i;
    outputs[at] = atan2_positive(inputs[4u * i + 1u], inputs[4u * i]);
    outputs[at + 1u] = half_turn.sine;
    outputs[at + 2u] = half_turn.cosine;
    outputs[at + 3u] = quarter_turn.sine;
    outputs[at + 4u] = quarter_turn.cosine;
    outputs[at + 5u] = angle_minus_sine(inputs[4u * i + 3u]);
    outputs[at + 6u] = one_minus_atan_ratio(inputs[4u * i + 3u]);
}
