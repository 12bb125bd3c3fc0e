#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: it samples the whole cap where a part is asked for.
#include "nusselt/bsdf/ggx_visible_normals.glsl"
#define ggx_bounded_visible_normals_prepare ggx_visible_normals_prepare
#include "parity/functions/visible_normals.glsl"
