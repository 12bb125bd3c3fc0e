#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: its quotients are off by a rounding, as those of some devices.
#include "nusselt/core/real.glsl"

float unrounded_quotient(float a, float b) {
    float q = a / b;
    return q > 0.0 ? uintBitsToFloat(floatBitsToUint(q) - 1u) : q;
}
#define rounded_quotient unrounded_quotient
#include "nusselt/random/light_random.glsl"
#include "parity/functions/light_random.glsl"
