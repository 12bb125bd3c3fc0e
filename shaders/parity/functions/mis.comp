#version 450
#extension GL_GOOGLE_include_directive : require
#include "nusselt/estimate/mis.glsl"
#include "parity/functions/mis.glsl"
