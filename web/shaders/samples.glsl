#ifndef PAGE_SAMPLES_GLSL
#define PAGE_SAMPLES_GLSL
/// What all techniques with samples share.

#include "nusselt/estimate/direct_light.glsl"
#include "lights.glsl"
#include "random.glsl"
#include "reflection.glsl"
#include "shadows.glsl"

bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

/// How many samples were not finite. No technique should return any; one would spoil the sum of its pixel for ever.
float rejected_samples = 0.0;

/// What a sample adds for an emission of 1. Traces its shadow ray.
vec3 contribution(Surface surface, DirectLightSample s) {
    bool is_shadowed = any(greaterThan(s.shadowed, vec3(0.0)));
    // The point is undefined where nothing needs a shadow ray.
    if (!(is_finite(s.shadowed) && is_finite(s.constant) && (!is_shadowed || is_finite(s.p)))) {
        rejected_samples += 1.0;
        return vec3(0.0);
    }
    vec3 term = s.constant;
    if (is_shadowed && is_visible(surface, s.p)) term += s.shadowed;
    return term;
}

#endif
