#ifndef NUSSELT_CORE_LIGHT_SAMPLE_GLSL
#define NUSSELT_CORE_LIGHT_SAMPLE_GLSL
// Follows include/nusselt/core/light_sample.h @ c597ad180c4c
/// The result of all techniques, and the hit point on planar lights. Twin of include/nusselt/core/light_sample.h.

#include "../core/vec.glsl"

/// A direction towards a light, in the frame in which the light was given.
struct LightSample {
    vec3 wi;   ///< unit direction from the shading point to the light
    float pdf; ///< density of wi; positive and finite, or exactly 0: no sample, wi and p are then meaningless
    vec3 p;    ///< the point on the light [m], relative to the shading point; the shadow ray leads there
};

/// The density of wi for a point that is uniform on the area of a light: distance^2 / projected [1/sr].
///
/// \param distance  of the point from the origin [m].
/// \param projected area of the light times the cosine at the point [m^2].
/// \returns no more than the largest number, 0 if distance is infinite or projected is not positive.
float area_density(float distance, float projected) {
    bool lit = projected > 0.0 && distance > 0.0 && is_finite(distance);
    // Divided in two steps, so that small lights far away do not overflow halfway.
    return lit ? nusselt_min(distance / projected * distance, kNusseltLargest) : 0.0;
}

/// The plane of a polygonal light as seen from the origin.
struct LightPlane {
    vec3 normal;    ///< unit, either side
    float distance; ///< dot(normal, p) for each point p of the plane [m]
    float farthest; ///< largest distance of a vertex from the origin [m]
};

/// Distance of the light along a unit direction that hits it, never farther than its farthest vertex.
float light_plane_distance_along(const LightPlane self, vec3 wi) {
    float cosine = dot(self.normal, wi);
    if (!(cosine * self.distance > 0.0)) return self.farthest;
    return nusselt_min(self.distance / cosine, self.farthest);
}

#endif
