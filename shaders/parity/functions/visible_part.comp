#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/line_emission/visible_part.glsl"
#include "parity/functions/visible_part.glsl"
