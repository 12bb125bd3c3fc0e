#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: weights end at the horizon, although parts of cells are above it.
#include "nusselt/emission/smooth_clamp.glsl"

vec4 sharp_clamp(vec4 mean, vec4 variance) { return max(mean, 0.0 * variance); }
#define smooth_clamp sharp_clamp
#include "nusselt/emission/environment_cosine.glsl"

#define Technique EnvironmentCosine
#define technique_prepare environment_cosine_prepare
#define technique_sample environment_cosine_sample
#define technique_pdf environment_cosine_pdf
#define technique_invert environment_cosine_invert
#define technique_measure environment_cosine_measure
#include "parity/environment.glsl"
