#pragma once
/// Environments in the form that kernels read: plain data, see kernel.h.

#include "render_cpu/kernel.h"

#include <cstdint>
#include <memory>

namespace nusselt::render_cpu {

/// Columns and rows of the lattice of cells over an environment map.
inline constexpr int kEnvironmentCells = 8;

struct EnvironmentRecord {
    scene::Float3 x_axis, y_axis, z_axis; ///< of the map, in world space
    scene::Float3 radiance;               ///< [W/(sr m^2)]; the mean if there is a map
    const void* map; ///< an EnvironmentMap<float, kEnvironmentCells>; null for the same radiance everywhere
    /// The portal in the form of ConvexPolygon<float, 4> or <float, 8>: its vertices and then its edges.
    const scene::Float3* corners;
    scene::Float3 normal;
    std::int32_t slots; ///< room for vertices, and for as many edges: 4 or 8; 0 without a portal
    /// What comes through the portal for points on both sides: a WindowedLight<float> each, or null without a portal or without
    /// a map. The normal of the first one leads to the points of the second one.
    const void* portal[2];
};

/// Makes an array of EnvironmentRecord, see LightKernel.
std::shared_ptr<const void> make_environment_records(const scene::Scene& scene, const scene::LightList& list);

// In kernel/lights/environment.cpp.
LightCode environment_code(LaneCount<4>), environment_code(LaneCount<8>), environment_code(LaneCount<16>);

} // namespace nusselt::render_cpu
