#ifndef NUSSELT_PASSES_LIGHTS_ENVIRONMENT_GLSL
#define NUSSELT_PASSES_LIGHTS_ENVIRONMENT_GLSL
/// Environments as a shading point and a camera see them, as in src/render_cpu/kernel/lights/environment.cpp.

#include "nusselt/emission/environment_map.glsl"
#include "passes/lights/emission_words.glsl"
#include "passes/lights/light_role.glsl"
#include "passes/lights/stored_polygon.glsl"

layout(constant_id = kUniformEnvironmentsConstant) const bool kHasUniformEnvironments = true;
layout(constant_id = kMappedEnvironmentsConstant) const bool kHasMappedEnvironments = true;
layout(constant_id = kUniformPortalsConstant) const bool kHasUniformPortals = true;
layout(constant_id = kMappedPortalsConstant) const bool kHasMappedPortals = true;
const bool kHasPortals = kHasUniformPortals || kHasMappedPortals;
const bool kHasSkies = kHasUniformEnvironments || kHasMappedEnvironments; ///< without a portal
const bool kHasEnvironments = kHasSkies || kHasPortals;

layout(set = 0, binding = kEnvironmentLightsBinding, std430) readonly buffer EnvironmentLights {
    EnvironmentLightRecord environment_lights[];
};

uint environment_map_word(uint at) { return emission_words[at]; }

/// Texels are in front of the words of their map.
vec3 environment_map_texel(uint map, ivec2 at) {
    int size = environment_map_size(map);
    return emission_texel(map - 3u * uint(size) * uint(size), uint(at.y) * uint(size) + uint(at.x));
}

/// A direction of world space in the space of the map.
vec3 to_map_space(uint index, vec3 w) {
    return vec3(dot(to_vec(environment_lights[index].x_axis), w), dot(to_vec(environment_lights[index].y_axis), w),
                dot(to_vec(environment_lights[index].z_axis), w));
}

/// The radiance that arrives from a direction of world space.
vec3 radiance_towards(uint index, vec3 w) {
    uint map = environment_lights[index].first_map_word;
    if ((kHasMappedEnvironments || kHasMappedPortals) && map != kNoWords)
        return environment_map_lookup(map, to_map_space(index, w));
    return to_vec(environment_lights[index].radiance);
}

bool has_portal(uint index) {
    return kHasPortals && (!kHasSkies || environment_lights[index].first_corner_word != kNoWords);
}

/// Whether a ray leaves through the portal of an environment.
bool leaves_through(uint index, const Ray ray) {
    uint first = environment_lights[index].first_corner_word;
    vec3 normal = to_vec(environment_lights[index].normal);
    float along = dot(normal, ray.direction);
    bool leaves = dot(normal, polygon_corner(first, 0) - ray.origin) * along > 0.0;
    // Edges wind around the ray, all in the same sense.
    for (int k = 0; k < LIGHT_VERTICES; ++k) {
        vec3 moment = cross(polygon_corner(first, k) - ray.origin, polygon_corner(first, LIGHT_VERTICES + k));
        leaves = leaves && dot(ray.direction, moment) * along >= 0.0;
    }
    return leaves;
}

/// What a ray sees that meets nothing [W/(sr m^2)].
vec3 background(const Ray ray) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < scene.lights[kEnvironmentKind].count; ++i)
        if (!has_portal(i) || leaves_through(i, ray)) sum += radiance_towards(i, nusselt_normalize(ray.direction));
    return sum;
}

#endif
