#pragma once
/// Planar convex polygons: the checks that light polygons must pass, and merging of triangles into them.

#include "scene/scene.h"
#include "scene/vector_math.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::scene {

constexpr std::size_t kMaxPolygonVertices = 8;

/// Sum of cross products of consecutive vertices: the right-hand normal, twice the area in length.
Double3 area_vector(const std::vector<Double3>& vertices);

/// What keeps these vertices from being a convex planar polygon, in words that name the vertex (counted from
/// 0) and the distance by which it is off; nothing if they are one. Deviations up to 1e-5 of the extent plus
/// 1e-6 of the largest coordinate are tolerated.
std::optional<std::string> find_polygon_defect(const std::vector<Double3>& vertices);

/// Removes vertices that coincide with a neighbour or lie on the line through both neighbours.
std::vector<Float3> without_collinear_vertices(const std::vector<Float3>& vertices);

/// A convex polygon made of triangles of a mesh.
struct MergedPolygon {
    std::vector<Float3> vertices;         ///< 3 to 8, no collinear ones; same orientation as the triangles
    std::vector<std::uint32_t> triangles; ///< indices into the given list
};

/// Greedily joins adjacent triangles to convex planar polygons of at most eight vertices. Adjacent are those
/// that share an edge between exactly equal positions and run through it in opposite directions. The
/// triangles must not be degenerate. The result is in the order of the first triangle of each polygon.
std::vector<MergedPolygon> merge_coplanar_triangles(const std::vector<Float3>& positions,
                                                    const std::vector<Triangle>& triangles);

} // namespace nusselt::scene
