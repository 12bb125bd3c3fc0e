#pragma once
/// A scene in the form of which Vulkan builds acceleration structures for ray queries.

#include "interface/query.h"
#include "scene/model/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nusselt::visibility {

/// Triangles that instances share, by their vertices in Scene::positions.
struct QueryPart {
    std::vector<std::uint32_t> opaque;  ///< three for each triangle
    std::vector<std::uint32_t> partial; ///< likewise: alpha decides whether a ray hits these
};

/// The geometry of shaders/passes/trace_query.glsl: the surfaces of TriangleBvh.
struct QueryGeometry {
    std::vector<QueryPart> parts; ///< the world, then the objects
    /// Number 0 is the world, number i + 1 Scene::instances[i]; shaders use these numbers for them.
    std::vector<interface::QueryInstance> instances;
    std::vector<std::uint32_t> partial_triangles; ///< indices into Scene::triangles
    /// Lower and upper corners, one box for each round light of the scene in place of its triangles; a point, the origin,
    /// for lights that rays do not meet.
    std::vector<std::array<float, 6>> round_boxes;
};

/// Triangles and round lights with coordinates that are not finite, or beyond 1.8e18, are left out.
QueryGeometry make_query_geometry(const scene::Scene& scene);

} // namespace nusselt::visibility
