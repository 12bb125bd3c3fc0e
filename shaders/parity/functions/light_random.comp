#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/random/light_random.glsl"
#include "parity/functions/light_random.glsl"
