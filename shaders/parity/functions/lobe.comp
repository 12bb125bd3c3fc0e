#version 450
#extension GL_GOOGLE_include_directive : require
#include "nusselt/ltc/light_transform.glsl"
#include "parity/functions/lobe.glsl"
