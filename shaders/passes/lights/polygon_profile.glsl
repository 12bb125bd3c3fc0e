#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_PROFILE_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_PROFILE_GLSL
/// How the radiance of polygonal lights depends on the direction, as in src/render_cpu/kernel/lights/polygon_light.h.

#include "passes/lights/profile.glsl"

layout(constant_id = kProfiledPolygonsConstant) const bool kHasProfiledPolygons = true;

/// The radiance in a direction over its mean. \param away unit, from the light, in the frame of the axes
float relative_radiance(uint profile, const ProfileAxes axes, vec3 away) {
    float share = 1.0;
    float inverse_slope = emission_float(profile + kProfileInverseSlope);
    vec2 inverse_holes =
        vec2(emission_float(profile + kProfileInverseHoles), emission_float(profile + kProfileInverseHoles + 1u));
    float along = dot(axes.normal, away);
    float inverse_cosine = 1.0 / nusselt_max(abs(along), kNusseltTiny);
    if (inverse_slope > 0.0) {
        vec3 across = away - along * axes.normal;
        share = nusselt_max(1.0 - sqrt(dot(across, across)) * inverse_cosine * inverse_slope, 0.0);
    }
    if (inverse_holes.x + inverse_holes.y > 0.0) {
        vec2 across = vec2(dot(axes.hole, away), dot(cross(axes.normal, axes.hole), away));
        vec2 slope = abs(across) * inverse_cosine;
        share *= nusselt_max(1.0 - slope.x * inverse_holes.x, 0.0) * nusselt_max(1.0 - slope.y * inverse_holes.y, 0.0);
    }
    if (!(share > 0.0)) return 0.0;
    return share * relative_luminance(profile, axes, away);
}

#endif
