#ifndef NUSSELT_PASSES_LIGHTS_POINT_GLSL
#define NUSSELT_PASSES_LIGHTS_POINT_GLSL
/// Point lights as a shading point sees them, as in src/render_cpu/kernel/lights/point.cpp.

#include "nusselt/core/trig.glsl"
#include "nusselt/emission/octahedral_map.glsl"
#include "passes/lights/luminaire.glsl"
#include "passes/lights/one_direction.glsl"
#include "passes/texture.glsl"

layout(constant_id = kPointsConstant) const bool kHasPoints = true; ///< isotropic ones and cones
layout(constant_id = kPointImagesConstant) const bool kHasPointImages = true;
layout(constant_id = kPointProfilesConstant) const bool kHasPointProfiles = true;
const bool kHasAnyPoints = kHasPoints || kHasPointImages || kHasPointProfiles;

layout(set = 0, binding = kPointLightsBinding, std430) readonly buffer PointLights { PointLightRecord point_lights[]; };

/// \param across the part of the direction across the axis
/// \param along  its cosine with the axis
float cone_share(const PointLightRecord light, vec3 across, float along) {
    // 1 - cosine, which a difference would cancel in narrow cones.
    float x = along > 0.0 ? dot(across, across) / (1.0 + along) : 1.0 - along;
    float t = nusselt_max(nusselt_min((light.cone_end - x) * light.inverse_cone_width, 1.0), 0.0);
    return light.distribution == kQuarticCone ? (t * t) * (t * t) : t * t * (3.0 - 2.0 * t);
}

/// Azimuth and inclination in parts of the whole.
vec2 latitude_place(vec3 w) {
    float half_turn = atan2_positive(abs(w.y), w.x);
    float azimuth = w.y < 0.0 ? 2.0 * kNusseltPi - half_turn : half_turn;
    float inclination = atan2_positive(sqrt(w.x * w.x + w.y * w.y), w.z);
    return vec2((1.0 / (2.0 * kNusseltPi)) * azimuth, (1.0 / kNusseltPi) * inclination);
}

/// \param place with v downwards, while rows of textures are numbered upwards
vec3 light_texel(const PointLightRecord light, vec2 place) {
    if (light.texture_number < 0) return vec3(1.0);
    return look_up_texture(uint(light.texture_number), vec2(place.x, 1.0 - place.y));
}

vec3 projection_share(const PointLightRecord light, vec3 w) {
    if (!(w.z > 0.0)) return vec3(0.0);
    float x = w.x / (w.z * light.half_extent[0]);
    float y = w.y / (w.z * light.half_extent[1]);
    if (!(max(abs(x), abs(y)) <= 1.0)) return vec3(0.0);
    return light_texel(light, vec2(0.5 + 0.5 * x, 0.5 + 0.5 * y));
}

/// The share of the intensity in a direction. \param away unit, in world space
vec3 point_share(const PointLightRecord light, vec3 away) {
    vec3 w = vec3(dot(to_vec(light.x_axis), away), dot(to_vec(light.y_axis), away), dot(to_vec(light.z_axis), away));
    if (light.distribution == kSmoothCone || light.distribution == kQuarticCone)
        return vec3(cone_share(light, away - w.z * to_vec(light.z_axis), w.z));
    if (kHasPointProfiles && light.distribution == kProfile) return vec3(intensity_in(light.first_luminaire_word, w));
    if (!kHasPointImages || light.distribution == kIsotropic) return vec3(1.0);
    if (light.distribution == kOctahedralImage) return light_texel(light, octahedral_coordinates(w));
    if (light.distribution == kLatitudeImage) return light_texel(light, latitude_place(w));
    return projection_share(light, w);
}

OneDirection local_point(const Surface surface, uint index) {
    PointLightRecord record = point_lights[index];
    vec3 way = to_vec(record.position) - surface.position;
    float squared = dot(way, way);
    // A light in the shading point itself has no direction. NaN stays.
    bool usable = !(squared <= 1.17549435e-38);
    float inverse = usable ? 1.0 / sqrt(squared) : 1.0;
    vec3 to_light = inverse * way;
    vec3 intensity = bounded(to_vec(record.intensity) * point_share(record, -to_light));
    return light_in_direction(surface, to_light, way, usable, (inverse * inverse) * intensity,
                              light_number(kPointKind, index));
}

#endif
