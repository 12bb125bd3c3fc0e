#pragma once
/// Planar convex polygons: the checks that polygons of lights must pass.

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

/// Describes why these vertices are no convex planar polygon, in words that name the vertex (counted from
/// 0) and the distance by which it is off; returns nothing if they are one. Deviations up to 1e-5 of the extent plus
/// 1e-6 of the largest coordinate are tolerated.
std::optional<std::string> find_polygon_defect(const std::vector<Double3>& vertices);

/// Whether an outline turns so little at a corner that the corner may be dropped.
bool is_straight(const Float3& before, const Float3& corner, const Float3& after);

/// Removes vertices that coincide with a neighbour or lie on the line through both neighbours.
std::vector<Float3> without_collinear_vertices(const std::vector<Float3>& vertices);

} // namespace nusselt::scene
