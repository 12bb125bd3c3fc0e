#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_PROFILE_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_PROFILE_GLSL
/// How the radiance of polygonal lights depends on the direction, as in src/render_cpu/kernel/lights/luminaire.h.

#include "passes/lights/luminaire.glsl"

layout(constant_id = kProfiledPolygonsConstant) const bool kHasProfiledPolygons = true;

/// The axes of a profile, the normal of its polygon and the x axis of the holes of its honeycomb, in any frame.
struct ProfileAxes {
    vec3 x, y, z, normal, hole;
};

/// The axes in world space.
ProfileAxes profile_axes(uint profile) {
    uint at = profile + kProfileAxes;
    return ProfileAxes(emission_vec3(at), emission_vec3(at + 3u), emission_vec3(at + 6u), emission_vec3(at + 9u),
                       emission_vec3(at + 12u));
}

ProfileAxes to_shading_space(ProfileAxes world, Frame frame) {
    return ProfileAxes(frame_to_local(frame, world.x), frame_to_local(frame, world.y), frame_to_local(frame, world.z),
                       frame_to_local(frame, world.normal), frame_to_local(frame, world.hole));
}

/// The radiance in a direction over its mean. \param away unit, from the light, in the frame of the axes
float relative_radiance(uint profile, ProfileAxes axes, vec3 away) {
    float value = emission_float(profile + kProfileInverseMean);
    float inverse_slope = emission_float(profile + kProfileInverseSlope);
    vec2 inverse_holes =
        vec2(emission_float(profile + kProfileInverseHoles), emission_float(profile + kProfileInverseHoles + 1u));
    float along = dot(axes.normal, away);
    float inverse_cosine = 1.0 / nusselt_max(abs(along), kNusseltTiny);
    if (inverse_slope > 0.0) {
        vec3 across = away - along * axes.normal;
        value *= nusselt_max(1.0 - sqrt(dot(across, across)) * inverse_cosine * inverse_slope, 0.0);
    }
    if (inverse_holes.x + inverse_holes.y > 0.0) {
        vec2 across = vec2(dot(axes.hole, away), dot(cross(axes.normal, axes.hole), away));
        vec2 slope = abs(across) * inverse_cosine;
        value *= nusselt_max(1.0 - slope.x * inverse_holes.x, 0.0) * nusselt_max(1.0 - slope.y * inverse_holes.y, 0.0);
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
