#pragma once
/// Planar convex polygons: the checks that light polygons must pass, and merging of triangles into them.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::scene {

constexpr std::size_t kMaxPolygonVertices = PolygonVertices::kCapacity;

/// Sum of cross products of consecutive vertices: the right-hand normal, twice the area in length.
Double3 area_vector(const std::vector<Double3>& vertices);

/// What keeps these vertices from being a convex planar polygon, in words that name the vertex (counted from
/// 0) and the distance by which it is off; nothing if they are one. Deviations up to 1e-5 of the extent plus
/// 1e-6 of the largest coordinate are tolerated.
std::optional<std::string> find_polygon_defect(const std::vector<Double3>& vertices);

/// Whether an outline turns by so little at a corner that it may be dropped.
bool is_straight(const Float3& before, const Float3& corner, const Float3& after);

/// Removes vertices that coincide with a neighbour or lie on the line through both neighbours.
std::vector<Float3> without_collinear_vertices(const std::vector<Float3>& vertices);

/// Triangles of a mesh, joined to convex polygons.
struct PolygonPartition {
    /// 3 to 8 vertices each, no collinear ones; same orientation as their triangles.
    std::vector<PolygonVertices> polygons;
    std::vector<std::int32_t> polygon_of_triangle;
};

/// Joins adjacent triangles to convex planar polygons of at most eight vertices: a flat region that is such a polygon as
/// a whole becomes one, others are joined greedily. Adjacent are those that share an edge between exactly equal
/// positions and run through it in opposite directions, if no third triangle does. The triangles must not be degenerate.
/// Polygons are in the order of their first triangles. Time and memory grow linearly, up to sorting.
PolygonPartition merge_coplanar_triangles(const std::vector<Float3>& positions,
                                          const std::vector<Triangle>& triangles);

} // namespace nusselt::scene
