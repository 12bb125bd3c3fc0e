#include "scene/build/polygons/polygon_merge.h"

#include "scene/build/polygons/flat_region.h"
#include "scene/model/polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace nusselt::scene {

namespace {

using PolygonId = std::uint32_t;

/// Outlines with more points, those on straight sides included, stop growing: each step looks at the whole outline.
constexpr std::size_t kMaxOutline = 64;

/// The part of two outlines that coincides: `count` edges, from the edges at `a` and `b` on (in the direction of the
/// respective outline).
struct SharedChain {
    std::size_t a, b, count;
};

/// Greedily joins the triangles of a flat region.
class RegionMerger {
public:
    /// \param index_of  per triangle of the mesh its index in `triangles`, unless it belongs to another region
    RegionMerger(const ConnectedMesh& mesh, const std::vector<TriangleId>& triangles,
                 const std::vector<std::uint32_t>& index_of, const std::vector<bool>& is_inside);
    void append_to(PolygonPartition& partition);

private:
    using Outline =
        std::vector<EdgeId>; ///< straight sides may consist of many edges, since neighbours need them

    void grow(PolygonId polygon);
    bool try_merge(PolygonId polygon, EdgeId edge);
    SharedChain shared_chain(const Outline& a, const Outline& b, EdgeId edge) const;
    bool turns_right(EdgeId incoming, EdgeId outgoing, const Double3& normal) const;
    bool is_light(const Outline& outline) const;
    std::vector<Float3> points(const Outline& outline) const;
    PolygonId owner(std::size_t index);

    const ConnectedMesh& mesh_;
    const std::vector<TriangleId>& triangles_;
    const std::vector<std::uint32_t>& index_of_;
    const std::vector<bool>& is_inside_;
    std::vector<Outline> outlines_; ///< emptied when merged into another
    std::vector<PolygonId> parent_; ///< the forest of merged polygons
};

/// Whether an outline without right turns goes around its inside only once: seen from its first point, the others
/// follow each other within half a turn.
bool goes_around_once(const std::vector<Double3>& points, const Double3& normal) {
    const auto is_left = [&](const Double3& a, const Double3& b) {
        constexpr double kTolerance = 1e-6; // of the sine of the angle
        return dot(cross(a, b), normal) >= -kTolerance * length(a) * length(b);
    };
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Double3 next = points[i + 1] - points[0];
        if (!is_left(points[i] - points[0], next) || !is_left(points[1] - points[0], next)) return false;
    }
    return true;
}

RegionMerger::RegionMerger(const ConnectedMesh& mesh, const std::vector<TriangleId>& triangles,
                           const std::vector<std::uint32_t>& index_of, const std::vector<bool>& is_inside)
    : mesh_(mesh),
      triangles_(triangles),
      index_of_(index_of),
      is_inside_(is_inside),
      parent_(triangles.size()) {
    for (const TriangleId t : triangles) outlines_.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    std::iota(parent_.begin(), parent_.end(), 0u);
}

PolygonId RegionMerger::owner(std::size_t index) {
    while (parent_[index] != index) {
        parent_[index] = parent_[parent_[index]];
        index = parent_[index];
    }
    return static_cast<PolygonId>(index);
}

void RegionMerger::append_to(PolygonPartition& partition) {
    for (PolygonId polygon = 0; polygon < outlines_.size(); ++polygon) grow(polygon);
    std::vector<std::int32_t> number(outlines_.size(), -1);
    for (PolygonId polygon = 0; polygon < outlines_.size(); ++polygon) {
        if (outlines_[polygon].empty()) continue;
        number[polygon] = static_cast<std::int32_t>(partition.polygons.size());
        partition.polygons.emplace_back(without_collinear_vertices(points(outlines_[polygon])));
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        partition.polygon_of_triangle[triangles_[i]] = number[owner(i)];
}

/// Goes around the outline until no edge leads to a polygon that can be joined.
void RegionMerger::grow(PolygonId polygon) {
    const Outline& outline = outlines_[polygon];
    std::size_t failures = 0;
    for (std::size_t i = 0; failures < outline.size(); ++i) {
        const EdgeId mate = mesh_.mate(outline[i % outline.size()]);
        const bool has_neighbour = mate != kNoEdge && is_inside_[mate / 3];
        if (has_neighbour && try_merge(polygon, outline[i % outline.size()])) {
            failures = 0;
        } else {
            ++failures;
        }
    }
}

SharedChain RegionMerger::shared_chain(const Outline& a, const Outline& b, EdgeId edge) const {
    const std::size_t na = a.size();
    const std::size_t nb = b.size();
    const auto index = [](const Outline& outline, EdgeId e) {
        return static_cast<std::size_t>(std::find(outline.begin(), outline.end(), e) - outline.begin());
    };
    std::size_t begin = index(a, edge);
    std::size_t end = index(b, mesh_.mate(edge)); // of the chain in b, which runs backwards
    std::size_t count = 1;
    const std::size_t limit = std::min(na, nb) - 1;
    while (count < limit && mesh_.mate(a[(begin + na - 1) % na]) == b[(end + 1) % nb]) {
        begin = (begin + na - 1) % na;
        end = (end + 1) % nb;
        ++count;
    }
    while (count < limit && mesh_.mate(a[(begin + count) % na]) == b[(end + nb - count) % nb]) ++count;
    return {begin, (end + nb + 1 - count) % nb, count};
}

bool RegionMerger::turns_right(EdgeId incoming, EdgeId outgoing, const Double3& normal) const {
    const Double3 corner = to_double(mesh_.position(mesh_.begin_of(outgoing)));
    const Double3 a = corner - to_double(mesh_.position(mesh_.begin_of(incoming)));
    const Double3 b = to_double(mesh_.position(mesh_.end_of(outgoing))) - corner;
    const double sine = dot(cross(a, b), normal); // times the lengths of both
    const double tolerance = 1e-6 * length(a) * length(b);
    const bool turns_back = std::fabs(sine) <= tolerance && dot(a, b) < 0;
    return sine < -tolerance || turns_back;
}

std::vector<Float3> RegionMerger::points(const Outline& outline) const {
    std::vector<Float3> result;
    for (const EdgeId edge : outline) result.push_back(mesh_.position(mesh_.begin_of(edge)));
    return result;
}

/// Whether an outline that nowhere turns right is a simple polygon in one plane with few enough corners.
bool RegionMerger::is_light(const Outline& outline) const {
    // A vertex that appears twice means a second contact beside the chain, around a hole.
    std::vector<PointId> sorted;
    for (const EdgeId edge : outline) sorted.push_back(mesh_.begin_of(edge));
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return false;
    const std::vector<Float3> vertices = points(outline);
    if (without_collinear_vertices(vertices).size() > kMaxPolygonVertices) return false;
    std::vector<Double3> exact;
    for (const Float3& vertex : vertices) exact.push_back(to_double(vertex));
    const Double3 normal = normalized(area_vector(exact));
    return is_planar(exact, normal) && goes_around_once(exact, normal);
}

bool RegionMerger::try_merge(PolygonId polygon, EdgeId edge) {
    const PolygonId neighbour = owner(index_of_[mesh_.mate(edge) / 3]);
    if (neighbour == polygon) return false;
    Outline& a = outlines_[polygon];
    Outline& b = outlines_[neighbour];
    const SharedChain chain = shared_chain(a, b, edge);
    const std::size_t na = a.size();
    const std::size_t nb = b.size();
    if (na + nb - 2 * chain.count < 3 || na + nb - 2 * chain.count > kMaxOutline) return false;
    // The union is convex where the chain ends, else nowhere concave if its parts are convex.
    const std::size_t a_end = (chain.a + chain.count) % na;
    const std::size_t b_end = (chain.b + chain.count) % nb;
    const Double3 normal = mesh_.area_vector(edge / 3);
    const Double3 unit_normal = normalized(normal);
    if (turns_right(a[(chain.a + na - 1) % na], b[b_end], unit_normal) ||
        turns_right(b[(chain.b + nb - 1) % nb], a[a_end], unit_normal))
        return false;

    Outline joined;
    for (std::size_t i = 0; i < na - chain.count; ++i) joined.push_back(a[(a_end + i) % na]);
    for (std::size_t i = 0; i < nb - chain.count; ++i) joined.push_back(b[(b_end + i) % nb]);
    if (!is_light(joined)) return false;
    a = std::move(joined);
    b = {};
    parent_[neighbour] = polygon;
    return true;
}

/// Triangles that are connected to `seed` by flat edges, which become `is_inside`.
void collect_region(const ConnectedMesh& mesh, TriangleId seed, std::vector<bool>& is_inside,
                    std::vector<TriangleId>& region) {
    region = {seed};
    is_inside[seed] = true;
    for (std::size_t i = 0; i < region.size(); ++i) {
        for (EdgeId edge = 3 * region[i]; edge < 3 * region[i] + 3; ++edge) {
            const auto neighbour = mesh.flat_neighbour(edge);
            if (!neighbour || is_inside[*neighbour]) continue;
            is_inside[*neighbour] = true;
            region.push_back(*neighbour);
        }
    }
    std::sort(region.begin(), region.end());
}

} // namespace

PolygonPartition merge_coplanar_triangles(const std::vector<Float3>& positions,
                                          const std::vector<Triangle>& triangles) {
    const ConnectedMesh mesh(positions, triangles);
    PolygonPartition result;
    result.polygon_of_triangle.resize(triangles.size(), -1);
    std::vector<bool> is_inside(triangles.size(), false); // the current region
    std::vector<std::uint32_t> index_of;
    std::vector<TriangleId> region;
    for (TriangleId seed = 0; seed < triangles.size(); ++seed) {
        if (result.polygon_of_triangle[seed] >= 0) continue;
        collect_region(mesh, seed, is_inside, region);
        if (const auto polygon = as_convex_polygon(mesh, region, is_inside)) {
            for (const TriangleId triangle : region)
                result.polygon_of_triangle[triangle] = static_cast<std::int32_t>(result.polygons.size());
            result.polygons.push_back(*polygon);
        } else {
            index_of.resize(triangles.size());
            for (std::size_t i = 0; i < region.size(); ++i)
                index_of[region[i]] = static_cast<std::uint32_t>(i);
            RegionMerger(mesh, region, index_of, is_inside).append_to(result);
        }
        for (const TriangleId triangle : region) is_inside[triangle] = false;
    }
    return result;
}

} // namespace nusselt::scene
