#pragma once
/// Round lights in the form that kernels read: plain data, see kernel.h.

#include "render_cpu/kernel.h"

#include <memory>

namespace nusselt::render_cpu {

/// Shapes with techniques of their own.
enum class RoundShape : std::int32_t { sphere, disk, ellipse, ellipsoid };

struct RoundRecord {
    RoundShape shape;
    scene::Float3 center;
    scene::Float3 axis[3]; ///< conjugate semi-diameters; the last one of flat lights is 0
    /// Rows of the inverse of the matrix with the axes, from world space to that of the unit sphere. Not for flat lights.
    scene::Float3 inverse[3];
    scene::Float3 normal; ///< of flat lights, unit, on the side that emits
    float radius;         ///< of spheres and disks
    scene::Float3 radiance;
    std::int32_t emits_outwards; ///< or to the side of the normal
    std::int32_t emits_inwards;  ///< or to the other side
    /// The largest similar ellipsoid around the centre that fits into the triangles of the scene, as a share of this one: at most
    /// 1. From inside, where all directions lead to the light, shadow rays end there.
    float shell;
};

/// Makes an array of RoundRecord, see LightKernel.
std::shared_ptr<const void> make_round_records(const scene::Scene& scene, const scene::LightList& list);

// In kernel/lights/round.cpp.
LightCode round_code(LaneCount<4>), round_code(LaneCount<8>), round_code(LaneCount<16>);

} // namespace nusselt::render_cpu
