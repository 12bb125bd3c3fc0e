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
/// \param line its direction, \param away unit, from the light: in the frame of the axes
float whole_spread_share(const LineEmissionProfile self, bool is_strip, vec3 line, vec3 away) {
    uint profile = self.profile;
    float inverse_slope = emission_float(profile + kProfileInverseSlope);
    if (!(inverse_slope > 0.0)) return 1.0;
    if (is_strip) return spread_share(profile, self.axes.normal, away);
    float along = dot(line, away);
    float sine = sqrt(nusselt_max(1.0 - along * along, kNusseltTiny));
    float at = abs(along) / sine * inverse_slope * float(kTubeSpreadCells);
    if (!(at < float(kTubeSpreadCells))) return 0.0;
    uint i = uint(at);
    float share = at - float(i);
    uint shares = emission_words[profile + kProfileTubeSpread] + i;
    return (1.0 - share) * emission_float(shares) + share * emission_float(shares + 1u);
}

/// The radiance of a linear light or a strip over its mean.
/// \param line its direction, \param away unit, from the light: in the frame of the axes
float radiance_of_line(const LineEmissionProfile self, bool is_strip, vec3 line, vec3 away) {
    return whole_spread_share(self, is_strip, line, away) * relative_luminance(self.profile, self.axes, away);
}

/// The radiance of a point of a tube over the mean. \param normal there, \param away unit, from the light
float radiance_of_tube(const LineEmissionProfile self, vec3 normal, vec3 away) {
    return spread_share(self.profile, normal, away) * relative_luminance(self.profile, self.axes, away);
}

#endif
