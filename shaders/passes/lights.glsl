#ifndef NUSSELT_PASSES_LIGHTS_GLSL
#define NUSSELT_PASSES_LIGHTS_GLSL
/// The kinds of light: each has a row here, in sample_lights.glsl and in integrate_lights.comp, and files in passes/lights.

#include "passes/lights/line.glsl"
#include "passes/lights/polygon.glsl"

/// Radiance that a ray sees of a light. \param number among all lights of the scene
vec3 light_emission(uint number, vec3 direction) {
    if (number < scene.polygon_lights) return polygon_emission(number, direction);
    return line_emission(number - scene.polygon_lights);
}

/// Radiance that a camera sees of lights themselves.
vec3 emission_of(DrawnTriangle drawn, Ray ray) {
    int number = triangles[drawn.triangle].light;
    return number < 0 ? vec3(0.0) : light_emission(uint(number), ray.direction);
}

#endif
