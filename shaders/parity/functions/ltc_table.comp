#version 450
#extension GL_GOOGLE_include_directive : require
#include "nusselt/ltc/table.glsl"
#include "parity/functions/ltc_table.glsl"
