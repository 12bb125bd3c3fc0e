#include "scene/build/polygons/flat_region.h"

#include "scene/model/polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nusselt::scene {

namespace {

/// The boundary edges of a region, sorted by the points at which they begin.
std::vector<std::pair<PointId, PointId>> boundary_edges(const ConnectedMesh& mesh,
                                                        const std::vector<TriangleId>& triangles,
                                                        const std::vector<bool>& is_inside) {
    std::vector<std::pair<PointId, PointId>> result;
    for (const TriangleId triangle : triangles) {
        for (EdgeId edge = 3 * triangle; edge < 3 * triangle + 3; ++edge) {
            const EdgeId mate = mesh.mate(edge);
            if (mate == kNoEdge || !is_inside[mate / 3])
                result.emplace_back(mesh.begin_of(edge), mesh.end_of(edge));
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// The points of the boundary in order; empty unless it is a single simple loop.
std::vector<PointId> outline(const std::vector<std::pair<PointId, PointId>>& edges) {
    std::vector<PointId> points;
    PointId point = edges.front().first;
    do {
        const auto edge = std::lower_bound(edges.begin(), edges.end(), std::pair(point, PointId{0}));
        if (edge == edges.end() || edge->first != point) return {};
        if (edge + 1 != edges.end() && (edge + 1)->first == point) return {};
        points.push_back(point);
        point = edge->second;
    } while (point != edges.front().first && points.size() < edges.size());
    return points.size() == edges.size() ? points : std::vector<PointId>{};
}

/// The points where an outline turns.
std::vector<Float3> turning_points(const ConnectedMesh& mesh, const std::vector<PointId>& points) {
    std::vector<Float3> result;
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i)
        if (!is_straight(mesh.position(points[(i + n - 1) % n]), mesh.position(points[i]),
                         mesh.position(points[(i + 1) % n])))
            result.push_back(mesh.position(points[i]));
    return result;
}

std::vector<Double3> all_corners(const ConnectedMesh& mesh, const std::vector<TriangleId>& triangles) {
    std::vector<Double3> result;
    result.reserve(3 * triangles.size());
    for (const TriangleId triangle : triangles)
        for (EdgeId edge = 3 * triangle; edge < 3 * triangle + 3; ++edge)
            result.push_back(to_double(mesh.position(mesh.begin_of(edge))));
    return result;
}

} // namespace

ConnectedMesh::ConnectedMesh(const std::vector<Float3>& positions, const std::vector<Triangle>& triangles)
    : positions_(positions), triangles_(triangles), adjacency_(find_adjacency(positions, triangles)) {}

Double3 ConnectedMesh::area_vector(TriangleId triangle) const {
    const Triangle& t = triangles_[triangle];
    const Double3 origin = to_double(positions_[t.vertex[0]]);
    return cross(to_double(positions_[t.vertex[1]]) - origin, to_double(positions_[t.vertex[2]]) - origin);
}

std::optional<TriangleId> ConnectedMesh::flat_neighbour(EdgeId edge) const {
    const EdgeId other = mate(edge);
    if (other == kNoEdge) return std::nullopt;
    constexpr double kMinCosine = 1 - 1e-6; // coarse: is_planar() decides
    const Double3 a = area_vector(edge / 3);
    const Double3 b = area_vector(other / 3);
    if (dot(a, b) < kMinCosine * length(a) * length(b)) return std::nullopt;
    return other / 3;
}

bool is_planar(const std::vector<Double3>& points, const Double3& unit_normal) {
    double extent = 0;
    double low = 0;
    double high = 0;
    for (const Double3& point : points) {
        const Double3 offset = point - points[0];
        extent = std::max(extent, length(offset));
        low = std::min(low, dot(offset, unit_normal));
        high = std::max(high, dot(offset, unit_normal));
    }
    constexpr double kTolerance = 1e-5;
    return high - low <= kTolerance * extent;
}

std::optional<PolygonVertices> as_convex_polygon(const ConnectedMesh& mesh,
                                                 const std::vector<TriangleId>& triangles,
                                                 const std::vector<bool>& is_inside) {
    const auto edges = boundary_edges(mesh, triangles, is_inside);
    if (edges.empty()) return std::nullopt;
    const std::vector<Float3> turns = turning_points(mesh, outline(edges));
    // Rounding may leave corners that are nearly straight.
    if (turns.size() < 3 || turns.size() > 2 * kMaxPolygonVertices) return std::nullopt;
    const std::vector<Float3> corners = without_collinear_vertices(turns);
    if (corners.size() > kMaxPolygonVertices) return std::nullopt;
    std::vector<Double3> vertices;
    for (const Float3& corner : corners) vertices.push_back(to_double(corner));
    if (find_polygon_defect(vertices)) return std::nullopt;

    const Double3 area = area_vector(vertices);
    if (!is_planar(all_corners(mesh, triangles), normalized(area))) return std::nullopt;
    // An outline may look like a polygon though the triangles within overlap.
    double triangle_area = 0;
    for (const TriangleId triangle : triangles) triangle_area += length(mesh.area_vector(triangle));
    constexpr double kTolerance = 1e-5;
    if (std::fabs(triangle_area - length(area)) > kTolerance * triangle_area) return std::nullopt;
    return corners;
}

} // namespace nusselt::scene
