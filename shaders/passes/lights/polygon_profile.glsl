#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_PROFILE_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_PROFILE_GLSL
/// How the radiance of polygonal lights depends on the direction, as in src/render_cpu/kernel/lights/luminaire.h.

#include "passes/lights/luminaire.glsl"

layout(constant_id = kProfiledPolygonsConstant) const bool kHasProfiledPolygons = true;

/// The axes of a profile and the normal of its polygon, in any frame.
struct ProfileAxes {
    vec3 x, y, z, normal;
};

/// The axes in world space.
ProfileAxes profile_axes(uint profile) {
    uint at = profile + kProfileAxes;
    return ProfileAxes(emission_vec3(at), emission_vec3(at + 3u), emission_vec3(at + 6u), emission_vec3(at + 9u));
}

ProfileAxes to_shading_space(ProfileAxes world, Frame frame) {
    return ProfileAxes(frame_to_local(frame, world.x), frame_to_local(frame, world.y), frame_to_local(frame, world.z),
                       frame_to_local(frame, world.normal));
}

/// The radiance in a direction over its mean. \param away unit, from the light, in the frame of the axes
float relative_radiance(uint profile, ProfileAxes axes, vec3 away) {
    float value = emission_float(profile + kProfileInverseMean);
    float inverse_slope = emission_float(profile + kProfileInverseSlope);
    if (inverse_slope > 0.0) {
        float along = dot(axes.normal, away);
        vec3 across = away - along * axes.normal;
        float slope = sqrt(dot(across, across)) / nusselt_max(abs(along), kNusseltTiny);
        value *= nusselt_max(1.0 - slope * inverse_slope, 0.0);
    }
    uint luminaire = emission_words[profile + kProfileLuminaire];
    if (luminaire == kNoWords || !(value > 0.0)) return value;
    vec3 w = vec3(dot(axes.x, away), dot(axes.y, away), dot(axes.z, away));
    float visible = 0.0;
    uint faces = emission_words[profile + kProfileFaceCount];
    for (uint i = 0u; i < faces; ++i) {
        uint face = profile + kProfileFaces + i * kProfileFaceWords;
        visible += emission_float(face + 3u) * nusselt_max(dot(emission_vec3(face), w), 0.0);
    }
    // Areas are relative to the least one that counts.
    return value * intensity_in(luminaire, w) / nusselt_max(visible, 1.0);
}

#endif
