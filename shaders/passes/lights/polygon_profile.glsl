#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_PROFILE_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_PROFILE_GLSL
/// How the radiance of polygonal lights depends on the direction, as in src/render_cpu/kernel/lights/polygon_light.h.

#include "passes/lights/profile.glsl"

layout(constant_id = kProfiledPolygonsConstant) const bool kHasProfiledPolygons = true;

/// The radiance in a direction over its mean. \param away unit, from the light, in the frame of the axes
float relative_radiance(uint profile, const ProfileAxes axes, vec3 away) {
    float share = spread_share(profile, axes.normal, away);
    vec2 inverse_holes =
        vec2(emission_float(profile + kProfileInverseHoles), emission_float(profile + kProfileInverseHoles + 1u));
    if (inverse_holes.x + inverse_holes.y > 0.0) {
        vec2 across = vec2(dot(axes.hole, away), dot(cross(axes.normal, axes.hole), away));
        vec2 slope = abs(across) / nusselt_max(abs(dot(axes.normal, away)), kNusseltTiny);
        share *= nusselt_max(1.0 - slope.x * inverse_holes.x, 0.0) * nusselt_max(1.0 - slope.y * inverse_holes.y, 0.0);
    }
    if (!(share > 0.0)) return 0.0;
    return share * relative_luminance(profile, axes, away);
}

#endif
