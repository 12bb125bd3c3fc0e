#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/ltc/light_transform.glsl"
#include "parity/functions/lobe.glsl"
