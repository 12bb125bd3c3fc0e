#ifndef PAGE_SAMPLES_GLSL
#define PAGE_SAMPLES_GLSL
/// What all techniques with samples share.

#include "nusselt/estimate/direct_light.glsl"
#include "lights.glsl"
#include "random.glsl"
#include "reflection.glsl"
#include "shadows.glsl"

bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

/// What a sample adds for an emission of 1. Traces its shadow ray.
vec3 contribution(Surface surface, DirectLightSample s) {
    vec3 term = s.constant;
    if (any(greaterThan(s.shadowed, vec3(0.0))) && is_visible(surface, s.p)) term += s.shadowed;
    return is_finite(term) ? term : vec3(0.0);
}

#endif
