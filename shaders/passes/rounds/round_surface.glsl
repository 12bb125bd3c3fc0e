#ifndef NUSSELT_PASSES_ROUNDS_ROUND_SURFACE_GLSL
#define NUSSELT_PASSES_ROUNDS_ROUND_SURFACE_GLSL
/// Where rays meet spheres, disks, ellipses and ellipsoids: src/visibility/round_surfaces.cpp in single precision. A
/// shader that includes this file must declare before a buffer with the array `RoundLightRecord round_lights[]`.

#include "nusselt/core/trig.glsl"
#include "nusselt/core/vec.glsl"
#include "passes/to_vec.glsl"

bool is_flat(uint light) { return round_lights[light].shape == kDisk || round_lights[light].shape == kEllipse; }

/// From the world to the space of the unit sphere. That of flat lights has metres along the normal.
vec3 in_unit_sphere(uint light, vec3 v) {
    return vec3(dot(to_vec(round_lights[light].inverse0), v), dot(to_vec(round_lights[light].inverse1), v),
                dot(to_vec(round_lights[light].inverse2), v));
}

/// A normal in the world, of any length. \param p in the space of the unit sphere of a solid light
vec3 normal_of_unit_sphere(uint light, vec3 p) {
    return p.x * to_vec(round_lights[light].inverse0) + p.y * to_vec(round_lights[light].inverse1) +
           p.z * to_vec(round_lights[light].inverse2);
}

/// From the centre in the world. \param p in the space of the unit sphere, in the plane z = 0 for flat lights
vec3 from_unit_sphere(uint light, vec3 p) {
    return p.x * to_vec(round_lights[light].axis0) + p.y * to_vec(round_lights[light].axis1) +
           p.z * to_vec(round_lights[light].axis2);
}

/// A ray in the space of the unit sphere.
struct UnitRay {
    vec3 origin, direction;
    float reach; ///< the largest coordinate of the origin, from the centre of the light [m]
};

UnitRay unit_ray(uint light, vec3 origin, vec3 direction) {
    vec3 from_center = origin - to_vec(round_lights[light].center);
    return UnitRay(in_unit_sphere(light, from_center), in_unit_sphere(light, direction),
                   largest_component(from_center));
}

/// Up to two places where a ray crosses a surface.
struct RoundCrossings {
    vec3 closest;  ///< the point of the ray that is closest to the centre, or in the plane of the light
    float middle;  ///< where the ray has it
    float half_way; ///< from there to both crossings; 0 for flat lights
    int count;
};

/// \param radius of the unit sphere, 1 or a little less; flat lights ignore it
RoundCrossings round_crossings(uint light, const UnitRay ray, float radius) {
    RoundCrossings result;
    if (is_flat(light)) {
        result.middle = -ray.origin.z / ray.direction.z;
        result.closest = ray.origin + result.middle * ray.direction;
        result.half_way = 0.0;
        // Comparisons with NaN are false.
        result.count = dot(result.closest.xy, result.closest.xy) <= 1.0 ? 1 : 0;
        return result;
    }
    float a = dot(ray.direction, ray.direction);
    result.middle = -dot(ray.origin, ray.direction) / a;
    // From the closest point, because the discriminant of the equation for t cancels for distant origins.
    result.closest = ray.origin + result.middle * ray.direction;
    float gap = radius * radius - dot(result.closest, result.closest);
    result.count = gap >= 0.0 ? 2 : 0;
    result.half_way = sqrt(nusselt_max(gap, 0.0) / a);
    return result;
}

/// In units of the direction, perhaps negative. \param i 0 or 1, in the order of the ray
float crossing_at(const RoundCrossings crossings, int i) {
    return crossings.middle + (i == 0 ? -crossings.half_way : crossings.half_way);
}

/// On the unit sphere, or in the unit disk.
vec3 crossing_point(uint light, const UnitRay ray, const RoundCrossings crossings, int i) {
    if (is_flat(light)) return vec3(crossings.closest.xy, 0.0);
    return nusselt_normalize(crossings.closest + (i == 0 ? -crossings.half_way : crossings.half_way) * ray.direction);
}

/// The texture coordinates of scene::surface(). \param point see crossing_point()
vec2 round_texture_coordinates(uint light, vec3 point) {
    float half_turn = atan2_positive(abs(point.y), point.x);
    float around = (point.y < 0.0 ? 2.0 * kNusseltPi - half_turn : half_turn) / (2.0 * kNusseltPi);
    float radius = sqrt(dot(point.xy, point.xy));
    return vec2(around, is_flat(light) ? 1.0 - radius : atan2_positive(radius, -point.z) / kNusseltPi);
}

#endif
