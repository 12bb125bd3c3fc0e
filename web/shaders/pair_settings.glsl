#ifndef PAGE_PAIR_SETTINGS_GLSL
#define PAGE_PAIR_SETTINGS_GLSL
/// How the samples of two techniques are combined.

#include "samples.glsl"

uniform int heuristic;             ///< kNusseltMis*
uniform float visibility_estimate; ///< fraction of lights that is visible, for the optimal heuristics

#endif
