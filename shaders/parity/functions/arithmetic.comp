#version 450
#extension GL_GOOGLE_include_directive : require
#include "nusselt/core/trig.glsl"
#include "nusselt/core/vec.glsl"
#include "parity/functions/arithmetic.glsl"
