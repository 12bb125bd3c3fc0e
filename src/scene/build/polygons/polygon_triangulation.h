#pragma once
/// Splits faces of meshes into triangles.

#include "scene/model/vector_math.h"

#include <vector>

namespace nusselt::scene {

/// Faces of more corners must be convex: others take time that grows with the square of the number of corners.
constexpr std::size_t kMaxConcaveCorners = 2048;

/// Splits a face into corners.size() - 2 triangles with its orientation, whose vertices are indices of corners. Convex
/// ones become a fan around the first corner, others are cut ear by ear, which is right for outlines that are planar up
/// to rounding and do not intersect themselves. Faces of fewer than three corners have none.
///
/// Throws std::runtime_error if the face is not convex and has more than kMaxConcaveCorners corners.
std::vector<Triangle> triangulate_polygon(const std::vector<Double3>& corners);

} // namespace nusselt::scene
