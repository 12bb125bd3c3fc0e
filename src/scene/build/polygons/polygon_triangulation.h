#pragma once
/// Splits faces of meshes into triangles.

#include "scene/model/vector_math.h"

#include <vector>

namespace nusselt::scene {

/// Faces of more corners must be convex: others take time that grows with the square of the number of corners.
constexpr std::size_t kMaxConcaveCorners = 2048;

/// Splits a face into triangles, whose vertices are indices of corners, like triangulate() of
/// nusselt/geometry/split_convex.h.
///
/// Throws std::runtime_error if the face is not convex and has more than kMaxConcaveCorners corners.
std::vector<Triangle> triangulate_polygon(const std::vector<Double3>& corners);

} // namespace nusselt::scene
