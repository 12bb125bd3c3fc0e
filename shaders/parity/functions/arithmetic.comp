#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/core/trig.glsl"
#include "nusselt/core/vec.glsl"
#include "parity/functions/arithmetic.glsl"
