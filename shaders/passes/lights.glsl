#ifndef NUSSELT_PASSES_LIGHTS_GLSL
#define NUSSELT_PASSES_LIGHTS_GLSL
/// The table of kinds of light. Another kind is a row here, with files in passes/lights that this file, sample_lights.glsl and
/// integrate_lights.comp include.

#include "passes/lights/distant.glsl"
#include "passes/lights/environment.glsl"
#include "passes/lights/line.glsl"
#include "passes/lights/point.glsl"
#include "passes/lights/polygon.glsl"
#include "passes/rounds/round.glsl"

/// A row has the number of the kind in interface/lights.h and two functions:
///
///     vec3 emission(uint index, Ray ray): the radiance that a ray sees of a light of this kind;
///     void add_lights(inout reflected): adds what a surface reflects of all lights of this kind; each pass has its own.
#define LIGHT_KINDS(ROW) \
    ROW(kPolygonKind, polygon_emission, add_polygons) \
    ROW(kLineKind, line_emission, add_lines) \
    ROW(kPointKind, no_emission, add_points) \
    ROW(kDistantKind, no_emission, add_distants) \
    ROW(kEnvironmentKind, no_emission, add_environments) \
    ROW(kRoundKind, round_emission, add_rounds)

/// Without a row for each kind, the array has no elements, which does not compile.
struct AllKinds {
#define COUNT_ROW(kind, emission, add_lights) +1
    int rows[0 LIGHT_KINDS(COUNT_ROW) == kLightKinds ? 1 : 0];
#undef COUNT_ROW
};

/// Radiance that a ray sees of a light. \param number among all lights of the scene
vec3 light_emission(uint number, const Ray ray) {
#define EMISSION_OF_ROW(kind, emission, add_lights) \
    if (is_of_kind(kind, number)) return emission(number - scene.lights[kind].first, ray);
    LIGHT_KINDS(EMISSION_OF_ROW)
#undef EMISSION_OF_ROW
    return vec3(0.0);
}

/// Adds the light of all kinds to what a pass has defined as `reflected`.
#define ADD_LIGHTS_OF_ROW(kind, emission, add_lights) add_lights(reflected);
#define ADD_ALL_LIGHTS LIGHT_KINDS(ADD_LIGHTS_OF_ROW)

/// Radiance that a camera sees of lights themselves.
vec3 emission_of(const DrawnTriangle drawn, const Ray ray) {
    int number = triangles[drawn.triangle].light;
    return number < 0 ? vec3(0.0) : light_emission(uint(number), ray);
}

#endif
