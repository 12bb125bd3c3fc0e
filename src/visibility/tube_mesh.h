#pragma once
/// Line lights as cameras see them.

#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::visibility {

/// Sides of a tube; the polygon with this many corners has the area of the circle.
inline constexpr int kTubeSides = 32;
/// Mantle and two caps.
inline constexpr int kTrianglesPerTube = 2 * kTubeSides + 2 * (kTubeSides - 2);

struct TubeMesh {
    std::vector<scene::Float3> positions;
    std::vector<scene::Triangle> triangles; ///< kTrianglesPerTube for each light in turn
};

/// Closed cylinders around all lights. Lights without length or radius give degenerate triangles.
TubeMesh make_tube_mesh(const std::vector<scene::LineLight>& lights);

} // namespace nusselt::visibility
