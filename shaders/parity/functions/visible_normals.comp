#version 450
#extension GL_GOOGLE_include_directive : require
#include "nusselt/bsdf/ggx_visible_normals.glsl"
#include "parity/functions/visible_normals.glsl"
