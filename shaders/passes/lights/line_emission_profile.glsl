#ifndef NUSSELT_PASSES_LIGHTS_LINE_EMISSION_PROFILE_GLSL
#define NUSSELT_PASSES_LIGHTS_LINE_EMISSION_PROFILE_GLSL
/// How the radiance of lines and tubes depends on the direction, as in src/render_cpu/kernel/lights/line_light.h.

#include "passes/lights/profile.glsl"

layout(constant_id = kProfiledLinesConstant) const bool kHasProfiledLines = true; ///< without extent
layout(constant_id = kProfiledTubesConstant) const bool kHasProfiledTubes = true;

struct LineEmissionProfile {
    uint profile;     ///< first word, kNoWords for the same radiance in all directions
    ProfileAxes axes; ///< in shading space, or in world space for cameras
};

bool has_emission_profile(const LineEmissionProfile self) {
    return (kHasProfiledLines || kHasProfiledTubes) && self.profile != kNoWords;
}

LineEmissionProfile local_emission_profile(uint profile, const Frame shading) {
    LineEmissionProfile self;
    self.profile = profile;
    if (has_emission_profile(self)) self.axes = to_shading_space(profile_axes(profile), shading);
    return self;
}

/// The share of radiance that the spread of a lateral surface or a strip passes as a whole.
/// \param along cosine of the direction with the light, \param cosine that with the normal of the light
float whole_spread_share(uint profile, bool is_strip, float along, float cosine) {
    float inverse_slope = emission_float(profile + kProfileInverseSlope);
    if (!(inverse_slope > 0.0)) return 1.0;
    if (is_strip) return spread_share(profile, abs(cosine));
    float sine = sqrt(nusselt_max(1.0 - along * along, kNusseltTiny));
    float at = abs(along) / sine * inverse_slope * float(kTubeSpreadCells);
    if (!(at < float(kTubeSpreadCells))) return 0.0;
    uint i = uint(at);
    float share = at - float(i);
    uint shares = emission_words[profile + kProfileTubeSpread] + i;
    return (1.0 - share) * emission_float(shares) + share * emission_float(shares + 1u);
}

/// The radiance of a linear light or a strip over its mean.
/// \param along direction of the line, \param away unit, from the light: in the frame of the axes
float radiance_of_line(const LineEmissionProfile self, bool is_strip, vec3 along, vec3 away) {
    return whole_spread_share(self.profile, is_strip, dot(along, away), dot(self.axes.normal, away)) *
           relative_luminance(self.profile, self.axes, away);
}

/// The radiance of a point of a tube over the mean. \param cosine of the direction with the normal there
float radiance_of_tube(const LineEmissionProfile self, float cosine, vec3 away) {
    return spread_share(self.profile, cosine) * relative_luminance(self.profile, self.axes, away);
}

#endif
