#version 450
#extension GL_GOOGLE_include_directive : require
#include "nusselt/random/light_random.glsl"
#include "parity/functions/light_random.glsl"
