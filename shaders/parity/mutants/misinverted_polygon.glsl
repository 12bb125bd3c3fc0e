// A mutant that the comparison must reject: the second random number that it finds belongs to another sample.
vec2 misinverted(const Technique technique, vec3 wi) {
    vec2 u = technique_invert(technique, wi);
    return vec2(u.x, u.y * u.y);
}
#undef technique_invert
#define technique_invert misinverted
#include "parity/polygon.glsl"
