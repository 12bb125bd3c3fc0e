#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: its differences of products cancel.
#include "nusselt/core/trig.glsl"
#include "nusselt/core/vec.glsl"

float plain_difference(float a, float b, float c, float d) { return a * b - c * d; }
#define difference_of_products plain_difference
#include "parity/functions/arithmetic.glsl"
