#pragma once
/// Finds the flat parts of triangle meshes, which become polygonal lights.

#include "scene/build/polygons/mesh_adjacency.h"
#include "scene/model/vector_math.h"

#include <optional>
#include <vector>

namespace nusselt::scene {

using PointId = std::uint32_t; ///< as MeshAdjacency::point_of_vertex
using TriangleId = std::uint32_t;

/// A mesh whose triangles have links to their neighbours.
class ConnectedMesh {
public:
    /// Both arguments must outlive this object.
    ConnectedMesh(const std::vector<Float3>& positions, const std::vector<Triangle>& triangles);

    /// See MeshAdjacency::mates.
    EdgeId mate(EdgeId edge) const { return adjacency_.mates[edge]; }
    PointId begin_of(EdgeId edge) const {
        return adjacency_.point_of_vertex[triangles_[edge / 3].vertex[edge % 3]];
    }
    PointId end_of(EdgeId edge) const { return begin_of(edge - edge % 3 + (edge + 1) % 3); }
    const Float3& position(PointId point) const { return positions_[point]; }
    /// The right-hand normal, twice the area in length.
    Double3 area_vector(TriangleId triangle) const;
    /// The neighbour at an edge if it lies in the same plane, up to rounding; otherwise empty.
    std::optional<TriangleId> flat_neighbour(EdgeId edge) const;

private:
    const std::vector<Float3>& positions_;
    const std::vector<Triangle>& triangles_;
    MeshAdjacency adjacency_;
};

/// Whether points lie in one plane with this unit normal, up to rounding.
bool is_planar(const std::vector<Double3>& points, const Double3& unit_normal);

/// Joins triangles to one polygon if that is planar and convex, without holes, and has few enough corners.
/// \param is_inside  per triangle of the mesh: whether it is one of `triangles`
std::optional<PolygonVertices> as_convex_polygon(const ConnectedMesh& mesh,
                                                 const std::vector<TriangleId>& triangles,
                                                 const std::vector<bool>& is_inside);

} // namespace nusselt::scene
