#pragma once
/// Finds the triangles of a mesh that share edges.

#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::scene {

/// Index of an edge of a triangle mesh: edge j of triangle i, from its vertex j to the next, is 3 * i + j.
using EdgeId = std::uint32_t;
constexpr EdgeId kNoEdge = 0xffffffff;

struct MeshAdjacency {
    /// For each vertex a number that all vertices at the same position share, below the number of vertices.
    std::vector<std::uint32_t> point_of_vertex;
    /// For each edge the one between the same points in the opposite direction; kNoEdge unless exactly two triangles meet
    /// there, in opposite directions.
    std::vector<EdgeId> mates;
};

/// \throws std::runtime_error if there are more than 2^30 triangles
MeshAdjacency find_adjacency(const std::vector<Float3>& positions, const std::vector<Triangle>& triangles);

} // namespace nusselt::scene
