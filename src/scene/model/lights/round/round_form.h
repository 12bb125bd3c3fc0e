#pragma once
/// Round lights in the form that renderers read.

#include "scene/model/float3.h"

#include <cstdint>
#include <vector>

namespace nusselt::scene {

struct Scene;

/// Shapes with techniques of their own.
enum class RoundShape : std::int32_t { sphere, disk, ellipse, ellipsoid };

/// Plain data: kernels for all instruction sets read it.
struct RoundForm {
    RoundShape shape;
    Float3 center;
    Float3 axis[3]; ///< conjugate semi-diameters; the last one of flat lights is 0
    /// Rows of the inverse of the matrix with the axes, from world space to that of the unit sphere. Not for flat lights.
    Float3 inverse[3];
    Float3 normal; ///< of flat lights, unit, on the side that emits
    float radius;  ///< of spheres and disks
    Float3 radiance;
    std::int32_t emits_outwards; ///< or to the side of the normal
    std::int32_t emits_inwards;  ///< or to the other side
};

/// The round lights of a scene, in their order.
std::vector<RoundForm> round_forms(const Scene& scene);

} // namespace nusselt::scene
