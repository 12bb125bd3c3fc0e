#ifndef NUSSELT_PASSES_LIGHTS_DISTANT_GLSL
#define NUSSELT_PASSES_LIGHTS_DISTANT_GLSL
/// Distant lights as a shading point sees them, as in src/render_cpu/kernel/lights/distant.cpp.

#include "passes/lights/one_direction.glsl"

layout(constant_id = kDistantsConstant) const bool kHasDistants = true;

layout(set = 0, binding = kDistantLightsBinding, std430) readonly buffer DistantLights { DistantLightRecord distant_lights[]; };

OneDirection local_distant(const Surface surface, uint index) {
    DistantLightRecord record = distant_lights[index];
    vec3 to_light = to_vec(record.to_light);
    // Longer than the scene, from any of its points.
    vec3 way = (4.0 * scene.radius) * to_light;
    return light_in_direction(surface, to_light, way, true, to_vec(record.irradiance), light_number(kDistantKind, index));
}

#endif
