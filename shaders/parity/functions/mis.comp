#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/estimate/mis.glsl"
#include "parity/functions/mis.glsl"
