// A mutant that the contract must reject: its density is infinite where there is no sample.
LightSample unguarded_sample(const Technique technique, vec2 u) {
    LightSample s = technique_sample(technique, u);
    if (s.pdf == 0.0) s.pdf = uintBitsToFloat(0x7f800000u);
    return s;
}
#undef technique_sample
#define technique_sample unguarded_sample
#include "parity/polygon.glsl"
