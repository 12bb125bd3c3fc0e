// A mutant that the comparison must reject: its hit points lie behind the light.
LightSample displaced_sample(const Technique technique, vec2 u) {
    LightSample s = technique_sample(technique, u);
    s.p = 1.001 * s.p;
    return s;
}
#undef technique_sample
#define technique_sample displaced_sample
#include "parity/polygon.glsl"
