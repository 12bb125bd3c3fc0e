#ifndef NUSSELT_CORE_LIGHT_SAMPLE_GLSL
#define NUSSELT_CORE_LIGHT_SAMPLE_GLSL
// Follows include/nusselt/core/light_sample.h @ 4056e7f9e991
/// The result of all techniques, and the hit point on planar lights. Twin of include/nusselt/core/light_sample.h.

#include "../core/vec.glsl"

/// A direction towards a light, in the frame in which the light was given.
struct LightSample {
    vec3 wi;   ///< unit direction from the shading point to the light
    float pdf; ///< density of wi; positive and finite, or exactly 0: no sample, wi and p are then meaningless
    vec3 p;    ///< the point on the light [m], relative to the shading point; the shadow ray ends there
};

/// The plane of a polygonal light as seen from the origin.
struct LightPlane {
    vec3 normal;    ///< unit, either side
    float distance; ///< dot(normal, p) for each point p of the plane [m]
    float farthest; ///< largest distance of a vertex from the origin [m]
};

/// Distance of the light along a unit direction that hits it, never farther than its farthest vertex.
float light_plane_distance_along(LightPlane self, vec3 wi) {
    float cosine = dot(self.normal, wi);
    if (!(cosine * self.distance > 0.0)) return self.farthest;
    return nusselt_min(self.distance / cosine, self.farthest);
}

#endif
