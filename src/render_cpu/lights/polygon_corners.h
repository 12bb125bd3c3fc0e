#pragma once
/// Polygons in the form that kernels read.

#include "scene/model/lights/polygon_light.h"

#include <cstdint>
#include <vector>

namespace nusselt::render_cpu {

/// How many vertices the record of a polygon has room for: 4 or 8.
std::int32_t slots_of(const scene::PolygonVertices& vertices);

/// A ConvexPolygon<float, slots>.
struct PolygonCorners {
    /// \param vertices at least 3
    explicit PolygonCorners(const scene::PolygonVertices& vertices);

    std::int32_t slots;
    std::vector<scene::Float3> corners; ///< vertices and then edges, `slots` of each
    scene::Float3 normal{0, 0, 0};
};

} // namespace nusselt::render_cpu
