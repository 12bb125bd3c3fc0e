#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: at the edges of the map, texels lack their neighbours across the edge.
#include "nusselt/emission/octahedral_map.glsl"

ivec2 clamp_octahedral(ivec2 at, int size) { return clamp(at, ivec2(0), ivec2(size - 1)); }
#define wrap_octahedral clamp_octahedral
#include "nusselt/emission/environment_cosine.glsl"

#define Technique EnvironmentCosine
#define technique_prepare environment_cosine_prepare
#define technique_sample environment_cosine_sample
// Software devices compile in less time what has no queries.
#define technique_pdf(technique, wi) 0.0
#define technique_invert(technique, wi) vec2(0.0)
#define technique_measure environment_cosine_measure
#include "parity/emission/environment.glsl"
