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
// Software devices compile in less time what has no queries.
#define technique_pdf(technique, wi) 0.0
#define technique_invert(technique, wi) vec2(0.0)
#define technique_measure environment_cosine_measure
#include "parity/emission/environment.glsl"
