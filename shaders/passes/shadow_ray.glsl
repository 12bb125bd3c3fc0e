#ifndef NUSSELT_PASSES_SHADOW_RAY_GLSL
#define NUSSELT_PASSES_SHADOW_RAY_GLSL
/// Rules for shadow rays, however they are traced: which rays are valid, and which surfaces with an alpha below 1 they meet.

#include "nusselt/core/vec.glsl"
#include "nusselt/random/pcg.glsl"
#include "nusselt/random/unit_interval.glsl"

/// As kLargestRayCoordinate of src/visibility/embree_scene.h.
const float kLargestRayCoordinate = 1e18;

/// Smaller directions may become zero on devices without subnormal numbers.
const float kSmallestRayDirection = 1.17549435082228750797e-38;

/// Stands for the instance of surfaces of the world.
const uint kNoInstance = ~0u;

struct ShadowRay {
    vec3 origin;
    vec3 direction;
    float t_far; ///< in units of the direction
};

/// Tells whether all coordinates are at most kLargestRayCoordinate; false for vectors with NaN.
bool is_in_ray_range(vec3 v) { return all(lessThanEqual(abs(v), vec3(kLargestRayCoordinate))); }

/// Rays that are not valid count as blocked, as on the CPU, so that no light comes from nowhere.
bool is_valid(const ShadowRay ray) {
    return is_in_ray_range(ray.origin) && is_in_ray_range(ray.direction) && ray.t_far >= 0.0 &&
           largest_component(ray.direction) >= kSmallestRayDirection;
}

/// Whether a ray meets a surface with this alpha. Each pair of a ray and a triangle decides on its own; for triangles of the
/// world, the decision is that of src/visibility/embree_scene.cpp.
bool meets_surface(const ShadowRay ray, uint triangle, uint instance, float alpha) {
    uvec4 place = pcg4d(uvec4(floatBitsToUint(ray.origin), triangle));
    uvec4 way = uvec4(floatBitsToUint(ray.direction), instance);
    return to_unit(pcg4d(place ^ way).x) < alpha;
}

#endif
