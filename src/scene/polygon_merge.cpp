#include "scene/polygon.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

namespace nusselt::scene {

namespace {

using VertexId = std::uint32_t;
using PolygonId = std::uint32_t;

/// A polygon under construction. Collinear vertices stay in the outline, since neighbours need them.
struct Outline {
    std::vector<VertexId> vertices;
    std::vector<std::uint32_t> triangles;
    Double3 unit_normal;
};

/// The part of two outlines that coincides: `count` edges, from the vertices `a` and `b` on (in the direction
/// of the respective outline).
struct SharedChain {
    std::size_t a, b, count;
};

class Merger {
public:
    Merger(const std::vector<Float3>& positions, const std::vector<Triangle>& triangles);
    std::vector<MergedPolygon> run();

private:
    static std::uint64_t edge_key(VertexId begin, VertexId end) {
        return (static_cast<std::uint64_t>(begin) << 32) | end;
    }
    void claim_edges(PolygonId polygon);
    void grow(PolygonId polygon);
    bool grow_once(PolygonId polygon);
    bool try_merge(PolygonId polygon, PolygonId neighbour, std::size_t edge);
    SharedChain shared_chain(const Outline& a, const Outline& b, std::size_t edge) const;
    bool turns_right(VertexId before, VertexId corner, VertexId after, const Double3& normal) const;
    bool is_planar(const std::vector<VertexId>& vertices) const;
    std::vector<Float3> corners(const std::vector<VertexId>& vertices) const;

    std::vector<Float3> positions_; ///< distinct ones
    std::vector<Outline> outlines_; ///< emptied when merged into another
    std::unordered_map<std::uint64_t, PolygonId> polygon_of_edge_;
};

Merger::Merger(const std::vector<Float3>& positions, const std::vector<Triangle>& triangles) {
    std::map<std::tuple<float, float, float>, VertexId> ids;
    std::vector<VertexId> id_of;
    for (const Float3& p : positions) {
        const auto [entry, is_new] =
            ids.try_emplace({p.x, p.y, p.z}, static_cast<VertexId>(positions_.size()));
        if (is_new) positions_.push_back(p);
        id_of.push_back(entry->second);
    }
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        Outline& outline = outlines_.emplace_back();
        std::vector<Double3> points;
        for (const std::uint32_t vertex : triangles[i].vertex) {
            outline.vertices.push_back(id_of[vertex]);
            points.push_back(to_double(positions[vertex]));
        }
        outline.triangles = {i};
        outline.unit_normal = normalized(area_vector(points));
        claim_edges(static_cast<PolygonId>(i));
    }
}

void Merger::claim_edges(PolygonId polygon) {
    const std::vector<VertexId>& vertices = outlines_[polygon].vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        polygon_of_edge_[edge_key(vertices[i], vertices[(i + 1) % vertices.size()])] = polygon;
}

std::vector<MergedPolygon> Merger::run() {
    for (PolygonId polygon = 0; polygon < outlines_.size(); ++polygon) grow(polygon);
    std::vector<MergedPolygon> result;
    for (Outline& outline : outlines_) {
        if (outline.vertices.empty()) continue;
        std::sort(outline.triangles.begin(), outline.triangles.end());
        result.push_back({corners(outline.vertices), outline.triangles});
    }
    const auto first_triangle = [](const MergedPolygon& a, const MergedPolygon& b) {
        return a.triangles.front() < b.triangles.front();
    };
    std::sort(result.begin(), result.end(), first_triangle);
    return result;
}

void Merger::grow(PolygonId polygon) {
    while (grow_once(polygon)) {
    }
}

bool Merger::grow_once(PolygonId polygon) {
    const std::vector<VertexId>& vertices = outlines_[polygon].vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const auto found = polygon_of_edge_.find(edge_key(vertices[(i + 1) % vertices.size()], vertices[i]));
        if (found != polygon_of_edge_.end() && found->second != polygon &&
            try_merge(polygon, found->second, i))
            return true;
    }
    return false;
}

SharedChain Merger::shared_chain(const Outline& a, const Outline& b, std::size_t edge) const {
    const auto& va = a.vertices;
    const auto& vb = b.vertices;
    const std::size_t na = va.size();
    const std::size_t nb = vb.size();
    std::size_t begin = edge; // in a
    std::size_t end =
        static_cast<std::size_t>(std::find(vb.begin(), vb.end(), va[begin]) - vb.begin()); // in b
    std::size_t count = 1;
    while (count < std::min(na, nb) - 1 && va[(begin + na - 1) % na] == vb[(end + 1) % nb]) {
        begin = (begin + na - 1) % na;
        end = (end + 1) % nb;
        ++count;
    }
    while (count < std::min(na, nb) - 1 &&
           va[(begin + count + 1) % na] == vb[(end + 2 * nb - count - 1) % nb])
        ++count;
    return {begin, (end + 2 * nb - count) % nb, count};
}

bool Merger::turns_right(VertexId before, VertexId corner, VertexId after, const Double3& normal) const {
    const Double3 a = to_double(positions_[corner]) - to_double(positions_[before]);
    const Double3 b = to_double(positions_[after]) - to_double(positions_[corner]);
    constexpr double kTolerance = 1e-6; // of the sine of the angle
    return dot(cross(a, b), normal) < -kTolerance * length(a) * length(b);
}

bool Merger::is_planar(const std::vector<VertexId>& vertices) const {
    std::vector<Double3> points;
    for (const VertexId vertex : vertices) points.push_back(to_double(positions_[vertex]));
    const Double3 normal = normalized(area_vector(points));
    double extent = 0;
    double low = 0;
    double high = 0;
    for (const Double3& point : points) {
        const Double3 offset = point - points[0];
        extent = std::max(extent, length(offset));
        low = std::min(low, dot(offset, normal));
        high = std::max(high, dot(offset, normal));
    }
    constexpr double kTolerance = 1e-5;
    return high - low <= kTolerance * extent;
}

std::vector<Float3> Merger::corners(const std::vector<VertexId>& vertices) const {
    std::vector<Float3> points;
    for (const VertexId vertex : vertices) points.push_back(positions_[vertex]);
    return without_collinear_vertices(points);
}

bool Merger::try_merge(PolygonId polygon, PolygonId neighbour, std::size_t edge) {
    Outline& a = outlines_[polygon];
    Outline& b = outlines_[neighbour];
    constexpr double kMinCosine = 1 - 1e-6; // coarse; is_planar() decides
    if (dot(a.unit_normal, b.unit_normal) < kMinCosine) return false;

    const std::size_t na = a.vertices.size();
    const std::size_t nb = b.vertices.size();
    const SharedChain chain = shared_chain(a, b, edge);
    // The union is convex where the chain ends, else nowhere concave if its parts are convex.
    const std::size_t a_end = (chain.a + chain.count) % na;
    const std::size_t b_end = (chain.b + chain.count) % nb;
    if (turns_right(a.vertices[(chain.a + na - 1) % na], a.vertices[chain.a], b.vertices[(b_end + 1) % nb],
                    a.unit_normal) ||
        turns_right(b.vertices[(chain.b + nb - 1) % nb], b.vertices[chain.b], a.vertices[(a_end + 1) % na],
                    a.unit_normal))
        return false;

    std::vector<VertexId> joined;
    for (std::size_t i = 0; i < na - chain.count; ++i) joined.push_back(a.vertices[(a_end + i) % na]);
    for (std::size_t i = 0; i < nb - chain.count; ++i) joined.push_back(b.vertices[(b_end + i) % nb]);
    // A vertex that appears twice means a second contact beside the chain, around a hole.
    std::vector<VertexId> sorted = joined;
    std::sort(sorted.begin(), sorted.end());
    if (joined.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return false;
    if (corners(joined).size() > kMaxPolygonVertices || !is_planar(joined)) return false;

    for (std::size_t i = 0; i < chain.count; ++i) {
        const VertexId begin = a.vertices[(chain.a + i) % na];
        const VertexId end = a.vertices[(chain.a + i + 1) % na];
        polygon_of_edge_.erase(edge_key(begin, end));
        polygon_of_edge_.erase(edge_key(end, begin));
    }
    a.vertices = std::move(joined);
    a.triangles.insert(a.triangles.end(), b.triangles.begin(), b.triangles.end());
    b = {};
    claim_edges(polygon);
    return true;
}

} // namespace

std::vector<MergedPolygon> merge_coplanar_triangles(const std::vector<Float3>& positions,
                                                    const std::vector<Triangle>& triangles) {
    return Merger(positions, triangles).run();
}

} // namespace nusselt::scene
