#ifndef NUSSELT_PASSES_LIGHTS_LINE_PROFILE_GLSL
#define NUSSELT_PASSES_LIGHTS_LINE_PROFILE_GLSL
/// Radiance that varies along lines and tubes, as in src/render_cpu/kernel/lights/line_light.h.

#include "nusselt/line_emission/line_profile.glsl"
#include "passes/lights/emission_words.glsl"

layout(constant_id = kTexturedLinesConstant) const bool kHasTexturedLines = true; ///< without extent
layout(constant_id = kTexturedTubesConstant) const bool kHasTexturedTubes = true;

uint line_profile_word(uint at) { return emission_words[at]; }

/// Radiance along a light.
struct LineRadiance {
    uint profile; ///< first word, kNoWords for uniform radiance
    vec3 inverse_mean;
};

bool varies(const LineRadiance self) {
    return (kHasTexturedLines || kHasTexturedTubes) && self.profile != kNoWords;
}

/// Radiance at a point over its mean.
vec3 relative_radiance(const LineRadiance self, const LineSegment axis, vec3 p) {
    return self.inverse_mean * line_profile_lookup(self.profile, place_along(axis, p));
}

#endif
