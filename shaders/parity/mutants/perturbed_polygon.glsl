// A mutant that the comparison must reject: the first random number is off by 16 roundings.
LightSample perturbed_sample(const Technique technique, vec2 u) {
    return technique_sample(technique, vec2(u.x + 9.5367431640625e-7, u.y));
}
#undef technique_sample
#define technique_sample perturbed_sample
#include "parity/polygon.glsl"
