#ifndef NUSSELT_PASSES_LIGHTS_ENVIRONMENT_GLSL
#define NUSSELT_PASSES_LIGHTS_ENVIRONMENT_GLSL
/// Environments as a shading point and a camera see them, as in src/render_cpu/kernel/lights/environment.cpp.

#include "nusselt/emission/environment_map.glsl"
#include "passes/lights/emission_words.glsl"
#include "passes/lights/light_role.glsl"

layout(constant_id = kUniformEnvironmentsConstant) const bool kHasUniformEnvironments = true;
layout(constant_id = kMappedEnvironmentsConstant) const bool kHasMappedEnvironments = true;
const bool kHasEnvironments = kHasUniformEnvironments || kHasMappedEnvironments;

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

/// What a ray sees that meets nothing [W/(sr m^2)].
vec3 background(Ray ray) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < scene.lights[kEnvironmentKind].count; ++i) {
        uint map = environment_lights[i].first_map_word;
        if (kHasMappedEnvironments && map != kNoWords)
            sum += environment_map_lookup(map, to_map_space(i, nusselt_normalize(ray.direction)));
        else
            sum += to_vec(environment_lights[i].radiance);
    }
    return sum;
}

#endif
