#version 450
#extension GL_GOOGLE_include_directive : require
#include "interface/fused_fma.h"
#include "nusselt/bsdf/ggx_visible_normals.glsl"
#include "parity/functions/visible_normals.glsl"
