// Published methods have no invert().
#undef technique_invert
#define technique_invert(technique, wi) 0.0
#include "parity/line.glsl"
