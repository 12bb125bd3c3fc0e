#ifndef NUSSELT_PASSES_LIGHTS_LIGHT_ROLE_GLSL
#define NUSSELT_PASSES_LIGHTS_LIGHT_ROLE_GLSL
/// Functions that all kinds of light share.

#include "passes/surface.glsl"

struct LightRole {
    bool is_lit;   ///< whether the light may reach the point
    vec3 emission; ///< radiance; that of thin lines times the radius
    uint number;   ///< among all lights of the scene
};

bool is_of_kind(int kind, uint number) { return number - scene.lights[kind].first < scene.lights[kind].count; }

/// The number of a light. \param index among the lights of its kind
uint light_number(int kind, uint index) { return scene.lights[kind].first + index; }

/// How many lights of a kind come before a number.
uint lights_before(int kind, uint number) {
    LightRange range = scene.lights[kind];
    return clamp(number, range.first, range.first + range.count) - range.first;
}

// The lights of a kind that this part of the frame samples, by their index in the kind.
uint first_index(int kind) { return lights_before(kind, frame.first_light); }
uint end_index(int kind) { return lights_before(kind, frame.light_end); }

#endif
