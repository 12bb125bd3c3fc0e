#pragma once
/// Projected solid angle sampling in scalar code: the vertices, azimuths and sectors of one ordinary light as lanes of a
/// pack. A light is ordinary if rounding does not decide which of its edges are outer ones, nor where the zenith lies;
/// azimuthal_sweep.h is for all others.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 3.2 and 3.7.

#include <nusselt/geometry/polygon_measures.h>
#include <nusselt/sampling/decentral_sector.h>
#include <nusselt/simd/across_lanes.h>

#if NUSSELT_HAS_VERTEX_LANES

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// Row m has, for each of L lanes, the next one of the m vertices of a polygon; lanes without a vertex stay.
template <int L>
struct NextVertex {
    std::int32_t lane[L + 1][L];
    constexpr NextVertex() noexcept : lane() {
        for (int m = 0; m <= L; ++m)
            for (int i = 0; i < L; ++i) lane[m][i] = i + 1 < m ? i + 1 : i + 1 == m ? 0 : i;
    }
};
template <int L>
inline constexpr NextVertex<L> kNextVertex;

} // namespace detail

/// \tparam L number of lanes, at least that of the vertices.
template <int L>
class VertexLanes {
    using P = Pack<float, L>;
    using M = Mask<float, L>;
    static constexpr float kRounding = std::numeric_limits<float>::epsilon();

public:
    /// \param count    of vertices, 3 to L.
    /// \param vertex_of, edge_of give the vertices and edges of the light above the horizon in shading space, as
    ///                 functions of the lane. Lanes from count on have edges of length zero at any of the vertices.
    /// \param normal   of the light.
    /// \param distance of its plane from the origin.
    template <class VertexOf, class EdgeOf>
    VertexLanes(int count, VertexOf vertex_of, EdgeOf edge_of, const Vec3<float>& normal,
                float distance) noexcept
        : count_(count), vertex_(make_vector_lanes<L>(vertex_of)), edge_(make_vector_lanes<L>(edge_of)) {
        // Whether edges are outer ones does not depend on the scale of the light.
        const std::int32_t* const next_lane = detail::kNextVertex<L>.lane[count];
        const std::uint32_t all_lanes = (std::uint32_t{1} << count) - 1;
        const P next_x = permute(vertex_.x, next_lane);
        const P next_y = permute(vertex_.y, next_lane);
        const P reach = abs(vertex_.x) + abs(vertex_.y);
        const P next_reach = permute(reach, next_lane);
        const P edge_reach = abs(edge_.x) + abs(edge_.y);
        const M first_closer = reach <= next_reach;
        const P turn =
            det(Vec2<P>{select(first_closer, vertex_.x, next_x), select(first_closer, vertex_.y, next_y)},
                xy(edge_));
        const P uncertain = P(16 * kRounding * largest_lane(edge_reach)) * max(reach, next_reach);
        const std::uint32_t certain = (abs(turn) > uncertain).bits() & all_lanes;
        const std::uint32_t positive = (turn > P(0)).bits() & all_lanes;

        // The zenith is at a vertex or on an edge within rounding.
        const P rounding(8 * kRounding * largest_lane(reach));
        const M across = vertex_.x * next_x + vertex_.y * next_y < P(0);
        const std::uint32_t touches =
            ((reach <= rounding) | (across & (abs(turn) <= rounding * edge_reach))).bits() & all_lanes;

        // Bring the light to coordinates of order one, and mirror it so that it is clockwise as seen from the origin.
        const float extent = largest_lane(max(max(abs(vertex_.x), abs(vertex_.y)), vertex_.z));
        const float scale = reciprocal_power_of_two(extent);
        inverse_scale_ = reciprocal_power_of_two(scale);
        mirror_ = copysign(1.0f, distance);
        const float mirrored = mirror_ * scale;
        vertex_ = {P(scale) * vertex_.x, P(mirrored) * vertex_.y, P(scale) * vertex_.z};
        edge_ = {P(scale) * edge_.x, P(mirrored) * edge_.y, P(scale) * edge_.z};
        turn_ = P(scale * scale) * abs(turn);
        hull_.low = {smallest_lane(vertex_.x), smallest_lane(vertex_.y), smallest_lane(vertex_.z)};
        hull_.high = {largest_lane(vertex_.x), largest_lane(vertex_.y), largest_lane(vertex_.z)};
        hull_.plane = {{normal.x, mirror_ * normal.y, normal.z},
                       scale * distance,
                       sqrt(largest_lane(dot(vertex_, vertex_)))};

        // Outer edges run counterclockwise around the zenith, inner ones clockwise (Sec. 3.7). In the decentral case both
        // are chains; in the central case there are no inner ones.
        outer_ = mirror_ > 0 ? positive : all_lanes & ~positive;
        const float height = hull_.plane.normal.z;
        const bool reaches_axis =
            (hull_.plane.distance * height >= 0) &
            (abs(hull_.plane.distance) <= multiply_add(abs(height), hull_.high.z, 8 * kRounding));
        is_central_ = outer_ == all_lanes;
        starts_ = outer_ & ~(outer_ << 1 | outer_ >> (count - 1));
        const bool has_two_chains = starts_ != 0 && (starts_ & (starts_ - 1)) == 0;
        // An edge on the horizon bounds the whole disk: it can only be an outer one.
        const std::uint32_t low = (vertex_.z <= P(0)).bits() & all_lanes;
        const std::uint32_t on_horizon = low & (low >> 1 | low << (count - 1));
        is_ordinary_ = (certain == all_lanes) & (touches == 0) & (extent > kSmallest) & (extent < kLargest) &
                       (abs(distance) > 0) & ((on_horizon & ~outer_) == 0) &
                       (is_central_ ? reaches_axis : has_two_chains);
    }

    /// Whether the other members may be used.
    bool is_ordinary() const noexcept { return is_ordinary_; }
    /// Whether the zenith is in the light.
    bool is_central() const noexcept { return is_central_; }
    float inverse_scale() const noexcept { return inverse_scale_; }
    float mirror() const noexcept { return mirror_; }
    /// Scaled and mirrored, like vertices and edges.
    const PolygonHull<float>& hull() const noexcept { return hull_; }
    const Vec3<P>& vertex() const noexcept { return vertex_; }
    const Vec3<P>& edge() const noexcept { return edge_; }
    /// The vertices after those of each lane.
    Vec3<P> next() const noexcept { return permute(vertex_, detail::kNextVertex<L>.lane[count_]); }
    /// The lanes with a vertex.
    M lanes() const noexcept { return M::from_bits((std::uint32_t{1} << count_) - 1); }

    /// The decentral sectors, in order of azimuth.
    /// \param present becomes the lanes that have one.
    DecentralSector<P> sectors(M& present) const noexcept {
        // Walk along both chains from the clockwise end of the light to the other one, always to the vertex that comes
        // next, and note which edge of the other chain lies at its azimuth.
        Vec3<float> offset_of[L];
        find_offsets(offset_of);
        Rays rays;
        walk(offset_of, rays);
        const P sign = P::load(rays.sign);
        const M is_outer = P::load(rays.outer) > P(0);
        const Vec3<P> offset = make_vector_lanes<L>([&](int j) { return offset_of[j]; });
        const Vec3<P> at = permute(offset, rays.vertex);
        const Vec3<P> from = permute(offset, rays.start);
        const Vec3<P> along = sign * permute(edge_, rays.edge);
        const Vec3<P> vertex = permute(vertex_, rays.vertex);
        const Vec3<P> start = permute(vertex_, rays.start);

        // Intersect that edge with the azimuth of the vertex.
        const Vec3<P> step = at - from;
        const M start_closer = abs(start.x) + abs(start.y) <= abs(vertex.x) + abs(vertex.y);
        const P way = det(select(start_closer, xy(start), xy(vertex)), xy(step));
        const P slope = det(xy(vertex), xy(along));
        const P safe_slope = select(slope > P(0), slope, P(1));
        const P x = min(max(way / safe_slope, P(0)), P(1));
        const Vec3<P> outer = select(is_outer, at, from + x * along);
        DecentralSector<P> sector;
        sector.begin = select(is_outer, vertex, start + x * along);
        sector.begin.z = max(sector.begin.z, P(0));

        // The gap between both circles at the outer point. The plane through the origin and an edge passes below the
        // vertex at a height that is twice the volume of a tetrahedron over the turn of the edge; twice its volume is the
        // distance of the plane of the light times an area in that plane. An inner vertex is above the outer point by
        // the ratio of their radii.
        const Vec3<P> area = cross(along, step);
        const Vec3<float>& normal = hull_.plane.normal;
        const P volume = abs(P(hull_.plane.distance) *
                             (P(normal.x) * area.x + P(normal.y) * area.y + P(normal.z) * area.z));
        const P gap = volume / select(is_outer, permute(turn_, rays.edge), safe_slope);

        const std::int32_t* const next_ray = detail::kNextVertex<L>.lane[L];
        sector.chord = permute(outer, next_ray) - outer;
        sector.begin_gap = gap;
        sector.end_gap = permute(gap, next_ray);
        sector.doubled_triangle = det(xy(sector.begin), xy(sector.chord));
        present = (sector.doubled_triangle > P(0)) & M::from_bits((std::uint32_t{1} << (count_ - 1)) - 1);
        const Vec3<P> none{P(0), P(0), P(0)};
        sector.chord = select(present, sector.chord, none);
        sector.begin_gap = select(present, sector.begin_gap, P(0));
        sector.end_gap = select(present, sector.end_gap, P(0));
        return sector;
    }

private:
    /// Extents for which products of coordinates stay in range before they are scaled.
    static constexpr float kSmallest = 1e-9f;
    static constexpr float kLargest = 1e9f;

    /// For each vertex, in order of azimuth.
    struct Rays {
        std::int32_t vertex[L];
        std::int32_t start[L]; ///< the vertex where the edge of the other chain begins
        std::int32_t edge[L];  ///< its lane
        float sign[L];         ///< -1 if the edge runs clockwise, as inner edges do
        float outer[L];        ///< whether the vertex belongs to the outer chain: 1 or 0
    };

    int next_lane(int j) const noexcept { return j + 1 < count_ ? j + 1 : 0; }
    int previous_lane(int j) const noexcept { return j > 0 ? j - 1 : count_ - 1; }

    /// Positions relative to vertex 0, accurate relative to the size of the light.
    void find_offsets(Vec3<float>* offset) const noexcept {
        Vec3<StoredLanes<L>> edge;
        visit_members(edge, edge_, [](auto& to, const P& from) { from.store(to.lane); });
        offset[0] = {0, 0, 0};
        for (int j = 1; j < L; ++j)
            offset[j] =
                offset[j - 1] + Vec3<float>{edge.x.lane[j - 1], edge.y.lane[j - 1], edge.z.lane[j - 1]};
    }

    void walk(const Vec3<float>* offset, Rays& rays) const noexcept {
        StoredLanes<L> x, y;
        vertex_.x.store(x.lane);
        vertex_.y.store(y.lane);
        int outer = 0;
        while ((starts_ >> outer & 1u) == 0) ++outer;
        int inner = outer;
        int end = outer;
        while ((outer_ >> end & 1u) != 0) end = next_lane(end);
        const auto note = [&](int ray, int vertex, int start, int edge, bool is_outer) {
            rays.vertex[ray] = vertex;
            rays.start[ray] = start;
            rays.edge[ray] = edge;
            rays.sign[ray] = is_outer ? -1.0f : 1.0f;
            rays.outer[ray] = is_outer ? 1.0f : 0.0f;
        };
        note(0, outer, outer, previous_lane(outer), true);
        for (int ray = 1; ray + 1 < count_; ++ray) {
            const int next_outer = next_lane(outer);
            const int next_inner = previous_lane(inner);
            const Vec3<float> step = offset[next_inner] - offset[next_outer];
            const bool outer_is_first = x.lane[next_outer] * step.y > y.lane[next_outer] * step.x;
            const bool is_outer = (next_inner == end) | ((next_outer != end) & outer_is_first);
            if (is_outer)
                note(ray, next_outer, inner, next_inner, true);
            else
                note(ray, next_inner, outer, outer, false);
            outer = is_outer ? next_outer : outer;
            inner = is_outer ? inner : next_inner;
        }
        for (int ray = count_ - 1; ray < L; ++ray) note(ray, end, end, end, true);
    }

    int count_;
    Vec3<P> vertex_, edge_;
    P turn_; ///< of each edge about the zenith: the determinant of its ends in the tangent plane, without sign
    std::uint32_t outer_;  ///< bits of the outer edges
    std::uint32_t starts_; ///< bits of the outer edges after an inner one
    PolygonHull<float> hull_;
    float inverse_scale_, mirror_;
    bool is_central_, is_ordinary_;
};

NUSSELT_NAMESPACE_END
#endif
