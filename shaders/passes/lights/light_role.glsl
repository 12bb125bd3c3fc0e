#ifndef NUSSELT_PASSES_LIGHTS_LIGHT_ROLE_GLSL
#define NUSSELT_PASSES_LIGHTS_LIGHT_ROLE_GLSL
/// What all kinds of light have in common.

#include "passes/surface.glsl"

struct LightRole {
    bool is_lit;   ///< whether it may light the point
    vec3 emission; ///< radiance, of thin lines times radius
    uint number;   ///< among all lights of the scene
};

#endif
