#ifndef NUSSELT_PASSES_LIGHTS_PROFILE_GLSL
#define NUSSELT_PASSES_LIGHTS_PROFILE_GLSL
/// What profiles of all shapes have in common, as in src/render_cpu/kernel/lights/luminaire.h.

#include "passes/lights/luminaire.glsl"

/// The axes of a profile, the normal of its light and the x axis of the holes of its honeycomb, in any frame.
struct ProfileAxes {
    vec3 x, y, z, normal, hole;
};

/// The axes in world space. \param profile its first word
ProfileAxes profile_axes(uint profile) {
    uint at = profile + kProfileAxes;
    return ProfileAxes(emission_vec3(at), emission_vec3(at + 3u), emission_vec3(at + 6u), emission_vec3(at + 9u),
                       emission_vec3(at + 12u));
}

ProfileAxes to_shading_space(const ProfileAxes world, const Frame frame) {
    return ProfileAxes(frame_to_local(frame, world.x), frame_to_local(frame, world.y), frame_to_local(frame, world.z),
                       frame_to_local(frame, world.normal), frame_to_local(frame, world.hole));
}

/// The share of radiance that a spread passes in a direction, to either side. The sine is the length of the part across the
/// normal: taken from the cosine, it would cancel for narrow spreads.
/// \param normal of the light at the point, \param away from it: unit, in the same frame
float spread_share(uint profile, vec3 normal, vec3 away) {
    float inverse_slope = emission_float(profile + kProfileInverseSlope);
    if (!(inverse_slope > 0.0)) return 1.0;
    float along = dot(normal, away);
    vec3 across = away - along * normal;
    float slope = sqrt(dot(across, across)) / nusselt_max(abs(along), kNusseltTiny);
    return nusselt_max(1.0 - slope * inverse_slope, 0.0);
}

/// The luminance of a profile without spread and honeycomb, over the mean. \param away unit, in the frame of the axes
float relative_luminance(uint profile, const ProfileAxes axes, vec3 away) {
    float inverse_mean = emission_float(profile + kProfileInverseMean);
    uint luminaire = emission_words[profile + kProfileLuminaire];
    if (luminaire == kNoWords) return inverse_mean;
    vec3 w = vec3(dot(axes.x, away), dot(axes.y, away), dot(axes.z, away));
    float along = dot(emission_vec3(profile + kProfileRoundAxis), w);
    float visible = emission_float(profile + kProfileRoundArea) * sqrt(nusselt_max(1.0 - along * along, 0.0));
    uint faces = emission_words[profile + kProfileFaceCount];
    for (uint i = 0u; i < faces; ++i) {
        uint face = profile + kProfileFaces + i * kProfileFaceWords;
        visible += emission_float(face + 3u) * nusselt_max(dot(emission_vec3(face), w), 0.0);
    }
    // Areas are relative to the least one that counts.
    return inverse_mean * intensity_in(luminaire, w) / nusselt_max(visible, 1.0);
}

#endif
