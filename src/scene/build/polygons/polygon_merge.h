#pragma once
/// Merges triangles into the polygons of lights.

#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::scene {

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
