#ifndef NUSSELT_PASSES_LIGHTS_ONE_DIRECTION_GLSL
#define NUSSELT_PASSES_LIGHTS_ONE_DIRECTION_GLSL
/// Lights without extent, as in src/render_cpu/kernel/lights/one_direction.h: each shading point receives their light from one
/// direction.

#include "passes/lights/light_role.glsl"

/// Emission and irradiance are bounded like the radiance of other lights: bright texels, and points next to a light, would
/// overflow.
vec3 bounded(vec3 light) { return nusselt_min(light, vec3(1e30)); }

struct OneDirection {
    vec3 wi; ///< unit direction to the light, in shading space
    vec3 p;  ///< where shadow rays end, in shading space
    LightRole role; ///< with the irradiance normal to the direction
};

/// \param to_light unit direction in world space
/// \param way      to the point where shadow rays end, in world space
/// \param usable   whether the light has a direction
OneDirection light_in_direction(const Surface surface, vec3 to_light, vec3 way, bool usable, vec3 irradiance,
                                uint number) {
    OneDirection light;
    light.wi = frame_to_local(surface.shading, to_light);
    light.p = frame_to_local(surface.shading, way);
    irradiance = bounded(irradiance);
    bool is_black = max(max(irradiance.x, irradiance.y), irradiance.z) <= 0.0;
    // Comparisons with NaN are false: negated they keep it, so that it is counted.
    light.role = LightRole(usable && !(light.wi.z <= 0.0) && !is_black, irradiance, number);
    return light;
}

/// No ray meets such lights.
vec3 no_emission(uint index, const Ray ray) { return vec3(0.0); }

#endif
