#ifndef PAGE_PAIR_SETTINGS_GLSL
#define PAGE_PAIR_SETTINGS_GLSL
/// How the samples of two techniques are combined, in place of the file of the live page: known to the compiler.

#include "samples.glsl"

const int heuristic = kNusseltMisClampedOptimal;
const float visibility_estimate = 0.5;

#endif
