#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/ltc/table.glsl"
#include "parity/functions/ltc_table.glsl"
