#include "scene/build/polygons/mesh_adjacency.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace nusselt::scene {

namespace {

/// Vertices at equal positions get the number of the first one in the order of positions.
std::vector<std::uint32_t> number_points(const std::vector<Float3>& positions) {
    const auto key = [&](std::uint32_t vertex) {
        const Float3& p = positions[vertex];
        return std::tuple(p.x, p.y, p.z);
    };
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> points(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_repeated = i > 0 && key(order[i]) == key(order[i - 1]);
        points[order[i]] = is_repeated ? points[order[i - 1]] : order[i];
    }
    return points;
}

/// An edge, comparable with its mate.
struct EdgeRecord {
    std::uint32_t low, high; ///< points
    EdgeId edge;
    bool is_ascending; ///< from low to high
};

} // namespace

MeshAdjacency find_adjacency(const std::vector<Float3>& positions, const std::vector<Triangle>& triangles) {
    constexpr std::size_t kMaxTriangles = std::size_t{1} << 30;
    if (triangles.size() > kMaxTriangles)
        throw std::runtime_error("an emissive mesh of more than 2^30 triangles");
    MeshAdjacency result{number_points(positions), std::vector<EdgeId>(3 * triangles.size(), kNoEdge)};
    std::vector<EdgeRecord> edges;
    edges.reserve(3 * triangles.size());
    for (EdgeId edge = 0; edge < 3 * triangles.size(); ++edge) {
        const Triangle& triangle = triangles[edge / 3];
        const std::uint32_t begin = result.point_of_vertex[triangle.vertex[edge % 3]];
        const std::uint32_t end = result.point_of_vertex[triangle.vertex[(edge + 1) % 3]];
        edges.push_back({std::min(begin, end), std::max(begin, end), edge, begin < end});
    }
    const auto key = [](const EdgeRecord& edge) { return std::tuple(edge.low, edge.high, edge.edge); };
    std::sort(edges.begin(), edges.end(),
              [&](const EdgeRecord& a, const EdgeRecord& b) { return key(a) < key(b); });
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        const EdgeRecord& first = edges[begin];
        while (end < edges.size() && edges[end].low == first.low && edges[end].high == first.high) ++end;
        const EdgeRecord& last = edges[end - 1];
        if (end - begin != 2 || first.is_ascending == last.is_ascending) continue;
        result.mates[first.edge] = last.edge;
        result.mates[last.edge] = first.edge;
    }
    return result;
}

} // namespace nusselt::scene
