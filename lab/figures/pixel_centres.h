#pragma once
/// What the centres of pixels see, for images that other code than the renderer shades.

#include "scene/model/scene.h"
#include "visibility/ray_packets.h"

#include <nusselt/core/vec.h>

namespace nusselt::lab {

/// Fills the ray of lane 0.
void put_ray(const Vec3<float>& origin, const Vec3<float>& direction, float t_far,
             visibility::RayPacket<4>& rays);

/// Vertices and indices are those of the scene; textures and instances do not count.
struct PixelCentre {
    Vec3<float> origin, direction;    ///< of the camera ray
    int triangle = -1;                ///< that is seen, or none
    int line = -1;                    ///< linear light that is seen, or none
    Vec3<float> position = {0, 0, 0}; ///< of a triangle
    Vec3<float> normal = {0, 0, 0};   ///< geometric, unit, on the side of the eye
};

/// Thread-safe.
PixelCentre see_centre(const scene::Scene& scene, const visibility::RayTracer& tracer, int x, int y);

/// The vector to where shadow rays start, from the position of a triangle.
Vec3<float> shadow_ray_offset(const scene::Scene& scene, const PixelCentre& seen);

} // namespace nusselt::lab
