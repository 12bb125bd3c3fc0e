// Published methods have no invert().
#undef technique_invert
#define technique_invert(technique, wi) vec2(0.0)
#include "parity/polygon.glsl"
