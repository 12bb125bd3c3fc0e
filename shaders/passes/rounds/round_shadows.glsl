#ifndef NUSSELT_PASSES_ROUNDS_ROUND_SHADOWS_GLSL
#define NUSSELT_PASSES_ROUNDS_ROUND_SHADOWS_GLSL
/// Which round lights block a shadow ray. With ROUND_LIGHTS, besides what round_surface.glsl needs, a shader that
/// includes this file must declare before:
///
///     a constant `bool kHasPartial`: whether the scene has surfaces with an alpha below 1;
///     `float alpha_on_round(uint triangle, vec2 uv)`: the alpha of the material of Scene::triangles[triangle] at
///     texture coordinates.

#include "passes/shadow_ray.glsl"

#if ROUND_LIGHTS
#include "passes/rounds/round_surface.glsl"

/// Rounding errors of rays in the space of the unit sphere, as a share of the distance between their origin and the
/// light.
const float kUnitRayRounding = 4e-7;
const float kMostShrinkage = 1e-3;

/// Whether a point lies in a solid light, or so close to it that rounding put it outside.
bool is_inside_or_near(uint light, vec3 point) {
    const float tolerance = 1e-5;
    float steepness = nusselt_length(normal_of_unit_sphere(light, point));
    return dot(point, point) - 1.0 <= 2.0 * (tolerance + round_lights[light].rounding * steepness);
}

/// Which crossings, as if the surface were everywhere, lie between the ends of a shadow ray. Rays end next to the
/// lights that they are for: up to rounding, points on the surface see all points of it that no other surface hides.
/// \returns bits
uint crossings_in_way(uint light, const UnitRay ray, float t_far) {
    vec3 end = ray.origin + t_far * ray.direction;
    float radius = 1.0;
    if (is_flat(light)) {
        // Rounding moves the ends of rays to the light to either side of it.
        if (abs(end.z) <= round_lights[light].rounding + kUnitRayRounding * ray.reach) return 0u;
    } else {
        // Solid lights are convex: from inside, only rays that end outside cross them.
        float squared = dot(ray.origin, ray.origin);
        if (squared < 1.0) return is_inside_or_near(light, end) ? 0u : 2u;
        if (dot(ray.origin, ray.direction) >= 0.0) return 0u;
        // From outside, a slightly smaller shape counts: rays that end on the rim must not end in its shadow.
        radius -= nusselt_min(round_lights[light].shrinkage + kUnitRayRounding * sqrt(squared), kMostShrinkage);
    }
    RoundCrossings crossings = round_crossings(light, ray, radius);
    uint in_way = 0u;
    for (int i = 0; i < 2; ++i) {
        float t = crossing_at(crossings, i);
        if (i < crossings.count && t > 0.0 && t < t_far) in_way |= 1u << uint(i);
    }
    return in_way;
}

/// Whether a surface with an alpha below 1 is there. Both crossings get random numbers of their own.
bool meets_crossing(const ShadowRay ray, uint light, vec3 point, int i) {
    uint triangle = round_lights[light].triangle;
    return meets_surface(ray, triangle, uint(i), alpha_on_round(triangle, round_texture_coordinates(light, point)));
}

/// Whether a round light lies between the ends of a shadow ray.
bool hits_round(const ShadowRay ray, uint light) {
    // Ray queries have a box for lights that rays do not meet, too: a point.
    if (round_lights[light].triangle == kNoTriangle) return false;
    UnitRay unit = unit_ray(light, ray.origin, ray.direction);
    uint in_way = crossings_in_way(light, unit, ray.t_far);
    if (!kHasPartial || round_lights[light].is_partial == 0u) return in_way != 0u;
    RoundCrossings crossings = round_crossings(light, unit, 1.0);
    for (int i = 0; i < 2; ++i)
        if ((in_way >> uint(i) & 1u) != 0u && meets_crossing(ray, light, crossing_point(light, unit, crossings, i), i))
            return true;
    return false;
}
#else
bool hits_round(const ShadowRay ray, uint light) { return false; }
#endif

#endif
