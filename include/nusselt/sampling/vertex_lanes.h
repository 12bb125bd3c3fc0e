#pragma once
/// Projected solid angle sampling in scalar code: the vertices, azimuths and sectors of one ordinary light as lanes of a
/// pack. A light is ordinary if rounding does not decide which of its edges are outer ones, nor where the zenith lies;
/// azimuthal_sweep.h is for all others.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 3.2 and 3.7.

#include <cstdint>
#include <limits>
#include <utility>

#include <nusselt/geometry/polygon_hull.h>
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

/// The azimuths of all vertices in the decentral case, in counterclockwise order.
template <int L>
struct AzimuthOrder {
    std::int32_t vertex[L]; ///< at the azimuth
    std::int32_t edge[L];   ///< of the other chain that meets the azimuth
    std::int32_t start[L];  ///< the vertex where it begins, going counterclockwise
    float sign[L];          ///< -1 if the vertex belongs to the outer chain: inner edges run clockwise

    /// Walks along both chains from the clockwise end of the light to the other one, always to the vertex that comes next.
    /// \param count       of vertices.
    /// \param outer_edges their bits; they follow each other.
    /// \param outer_is_first tells whether an outer vertex comes before an inner one.
    template <class OuterIsFirst>
    constexpr AzimuthOrder(int count, std::uint32_t outer_edges, const OuterIsFirst& outer_is_first) noexcept
        : vertex(), edge(), start(), sign() {
        const auto next = [&](int j) { return j + 1 < count ? j + 1 : 0; };
        const auto previous = [&](int j) { return j > 0 ? j - 1 : count - 1; };
        const auto is_outer_edge = [&](int j) { return (outer_edges >> j & 1u) != 0; };
        int outer = 0;
        while (outer + 1 < count && !(is_outer_edge(outer) && !is_outer_edge(previous(outer)))) ++outer;
        int end = outer;
        for (int j = 0; j < count && is_outer_edge(end); ++j) end = next(end);
        int inner = outer;
        set(0, outer, previous(outer), outer, true);
        for (int i = 1; i + 1 < count; ++i) {
            const int next_outer = next(outer);
            const int next_inner = previous(inner);
            const bool is_outer =
                next_inner == end || (next_outer != end && outer_is_first(next_outer, next_inner));
            if (is_outer) {
                set(i, next_outer, next_inner, inner, true);
                outer = next_outer;
            } else {
                set(i, next_inner, outer, outer, false);
                inner = next_inner;
            }
        }
        for (int i = count - 1; i < L; ++i) set(i, end, end, end, true);
    }

private:
    constexpr void set(int i, int vertex_at, int edge_at, int start_at, bool is_outer) noexcept {
        vertex[i] = vertex_at;
        edge[i] = edge_at;
        start[i] = start_at;
        sign[i] = is_outer ? -1.0f : 1.0f;
    }
};

/// The orders of triangles and quadrilaterals. At most one pair of vertices is not ordered by the chains: opposite ones.
struct SmallOrders {
    AzimuthOrder<4> order[2][16][2];
    /// \param count       3 or 4.
    /// \param outer_edges their bits.
    /// \param first       bit j: vertex j comes before the opposite one.
    const AzimuthOrder<4>& find(int count, std::uint32_t outer_edges, std::uint32_t first) const noexcept {
        // With two outer edges, the vertex between them is the one in question.
        const std::uint32_t between = outer_edges & (outer_edges << 1 | outer_edges >> 3);
        return order[count - 3][outer_edges][(first & between) != 0];
    }
};
template <int Count, std::uint32_t OuterEdges>
constexpr AzimuthOrder<4> small_order(bool outer_is_first) noexcept {
    return {Count, OuterEdges, [outer_is_first](int, int) { return outer_is_first; }};
}
template <int Count, std::uint32_t... OuterEdges>
constexpr SmallOrders make_small_orders(std::integer_sequence<std::uint32_t, OuterEdges...>) noexcept {
    return {{{{small_order<3, OuterEdges>(false), small_order<3, OuterEdges>(true)}...},
             {{small_order<4, OuterEdges>(false), small_order<4, OuterEdges>(true)}...}}};
}
inline constexpr SmallOrders kSmallOrders =
    make_small_orders<4>(std::make_integer_sequence<std::uint32_t, 16>());

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
    /// \param distance_of gives the distance of its plane from the origin.
    template <class VertexOf, class EdgeOf, class DistanceOf>
    NUSSELT_INLINE VertexLanes(int count, VertexOf vertex_of, EdgeOf edge_of, const Vec3<float>& normal,
                               DistanceOf distance_of) noexcept
        : count_(count), vertex_(make_vector_lanes<L>(vertex_of)), edge_(make_vector_lanes<L>(edge_of)) {
        const std::uint32_t all_lanes = (std::uint32_t{1} << count) - 1;
        const std::int32_t* const next_lane = detail::kNextVertex<L>.lane[count];

        // Outer edges run counterclockwise around the zenith, inner ones clockwise (Sec. 3.7), if the light is clockwise
        // as seen from the origin; else it is to be mirrored. This depends on signs only, not on the scale.
        const Vec2<P> next{permute<L>(vertex_.x, next_lane), permute<L>(vertex_.y, next_lane)};
        const P reach = abs(vertex_.x) + abs(vertex_.y);
        const P next_reach = permute<L>(reach, next_lane);
        const P edge_reach = abs(edge_.x) + abs(edge_.y);
        const P turn = det(select(reach <= next_reach, xy(vertex_), next), xy(edge_));
        const P turn_size = abs(turn);
        mirror_ = copysign(1.0f, dot(normal, vertex_of(0)));
        outer_edges_ = (turn * P(mirror_) > P(0)).bits() & all_lanes;
        is_central_ = outer_edges_ == all_lanes;
        offset_ = sums_before(edge_);
        if constexpr (L == 4) {
            const P toward_x = opposite(offset_.x) - offset_.x;
            const P toward_y = opposite(offset_.y) - offset_.y;
            before_opposite_ = (P(mirror_) * (vertex_.x * toward_y - vertex_.y * toward_x) > P(0)).bits();
        }

        // Bring the light to coordinates of order one, and mirror it.
        const P size = max(max(abs(vertex_.x), abs(vertex_.y)), vertex_.z);
        const float extent = largest_lane(size);
        const float scale = reciprocal_power_of_two(extent);
        inverse_scale_ = reciprocal_power_of_two(scale);
        const Vec3<P> scales{P(scale), P(mirror_ * scale), P(scale)};
        vertex_ = scales * vertex_;
        edge_ = scales * edge_;
        offset_ = scales * offset_;
        const Vec3<float> base = vertex_of(0);
        base_ = {scale * base.x, mirror_ * scale * base.y, scale * base.z};
        turn_ = P(scale * scale) * turn_size;
        const float distance = scale * distance_of();
        hull_.low = {smallest_lane(vertex_.x), smallest_lane(vertex_.y), smallest_lane(vertex_.z)};
        hull_.high = {largest_lane(vertex_.x), largest_lane(vertex_.y), largest_lane(vertex_.z)};
        hull_.plane = {
            {normal.x, mirror_ * normal.y, normal.z}, distance, sqrt(largest_lane(dot(vertex_, vertex_)))};

        // Rounding must not decide which edges are outer ones, nor whether the zenith is at a vertex or on an edge.
        const P uncertain_turn = P(16 * kRounding * largest_lane(edge_reach)) * max(reach, next_reach);
        const P uncertain_reach(8 * kRounding * largest_lane(reach));
        const M across =
            dot(Vec2<P>{vertex_.x, vertex_.y}, Vec2<P>{next.x * scales.x, next.y * scales.y}) < P(0);
        const M uncertain = (turn_size <= uncertain_turn) | (reach <= uncertain_reach) |
                            (across & (turn_size <= uncertain_reach * edge_reach));
        // In the central case, the plane has the height distance / normal.z on the zenith's axis. In the decentral case,
        // outer edges follow each other.
        const bool reaches_axis = (distance * normal.z >= 0) &
                                  (abs(distance) <= multiply_add(abs(normal.z), hull_.high.z, 8 * kRounding));
        const std::uint32_t starts = outer_edges_ & ~(outer_edges_ << 1 | outer_edges_ >> (count - 1));
        const bool are_chains = starts != 0 && (starts & (starts - 1)) == 0;
        // An edge on the horizon bounds the whole disk: it can only be an outer one.
        const std::uint32_t low = (vertex_.z <= P(0)).bits() & all_lanes;
        const std::uint32_t inner_on_horizon = low & (low >> 1 | low << (count - 1)) & ~outer_edges_;
        is_ordinary_ = ((uncertain.bits() & all_lanes) | inner_on_horizon) == 0 && extent > kSmallest &&
                       extent < kLargest && distance * mirror_ > 0 &&
                       (is_central_ ? reaches_axis : are_chains);
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
    Vec3<P> next() const noexcept { return permute<L>(vertex_, detail::kNextVertex<L>.lane[count_]); }
    /// The lanes with a vertex.
    M lanes() const noexcept { return M::from_bits((std::uint32_t{1} << count_) - 1); }

    /// Number of vertices.
    int count() const noexcept { return count_; }

    /// The decentral sectors, in order of azimuth.
    /// \tparam S      at least count() - 1: there is one sector less than vertices.
    /// \param present becomes the lanes that have one.
    template <int S>
    NUSSELT_INLINE DecentralSector<Pack<float, S>> sectors(Mask<float, S>& present) const noexcept {
        if constexpr (L == 4) {
            return sectors_in_order(detail::kSmallOrders.find(count_, outer_edges_, before_opposite_),
                                    present);
        } else {
            Vec3<StoredLanes<L>> position, offset;
            const auto store = [](StoredLanes<L>& to, const P& from) { from.store(to.lane); };
            visit_members(position, vertex_, store);
            visit_members(offset, offset_, store);
            const auto outer_is_first = [&](int outer, int inner) {
                return position.x.lane[outer] * (offset.y.lane[inner] - offset.y.lane[outer]) >
                       position.y.lane[outer] * (offset.x.lane[inner] - offset.x.lane[outer]);
            };
            return sectors_in_order(detail::AzimuthOrder<L>(count_, outer_edges_, outer_is_first), present);
        }
    }

private:
    /// Extents for which products of coordinates stay in range before they are scaled.
    static constexpr float kSmallest = 0x1p-40f;
    static constexpr float kLargest = 0x1p40f;

    /// What belongs to the opposite vertex of a quadrilateral.
    static P opposite(const P& p) noexcept {
        constexpr std::int32_t kOpposite[] = {2, 3, 0, 1};
        return permute<L>(p, kOpposite);
    }

    template <int S>
    NUSSELT_INLINE DecentralSector<Pack<float, S>> sectors_in_order(const detail::AzimuthOrder<L>& order,
                                                                    Mask<float, S>& present) const noexcept {
        using Q = Pack<float, S>;
        const Q sign = Q::load(order.sign);
        const Mask<float, S> is_outer = sign < Q(0);
        const Vec3<Q> at = permute<S>(offset_, order.vertex);
        const Vec3<Q> from = permute<S>(offset_, order.start);
        const Vec3<Q> along = sign * permute<S>(edge_, order.edge);
        const Vec3<Q> vertex = permute<S>(vertex_, order.vertex);
        const Vec3<Q> start = permute<S>(vertex_, order.start);

        // Intersect that edge with the azimuth of the vertex.
        const Vec3<Q> step = at - from;
        const Mask<float, S> start_closer = abs(start.x) + abs(start.y) <= abs(vertex.x) + abs(vertex.y);
        const Q way = det(select(start_closer, xy(start), xy(vertex)), xy(step));
        const Q slope = det(xy(vertex), xy(along));
        const Q safe_slope = select(slope > Q(0), slope, Q(1));
        const Q x = min(max(way / safe_slope, Q(0)), Q(1));
        const Vec3<Q> outer = select(is_outer, at, from + x * along);
        DecentralSector<Q> sector;
        // Begins and chords have the rounding errors of the same offsets, so that sectors meet.
        sector.begin = Vec3<Q>{Q(base_.x), Q(base_.y), Q(base_.z)} + outer;
        sector.begin.z = max(sector.begin.z, Q(0));

        const Vec3<float>& normal = hull_.plane.normal;
        const AzimuthOnEdge<Q> azimuth{xy(vertex), along, step, way, slope};
        const Q gap = azimuth.gap({Q(normal.x), Q(normal.y), Q(normal.z)}, Q(hull_.plane.distance),
                                  select(is_outer, -permute<S>(turn_, order.edge), safe_slope));

        // Sectors end where the next ones begin. Both chains meet in the last vertex.
        const std::int32_t* const next_azimuth = detail::kNextVertex<S>.lane[S];
        Vec3<Q> end = permute<S>(outer, next_azimuth);
        sector.end_gap = permute<S>(gap, next_azimuth);
        if constexpr (S < L) {
            const auto last_lane = Mask<float, S>::from_bits(std::uint32_t{1} << (S - 1));
            end = select(last_lane, permute<S>(offset_, order.vertex + S), end);
            sector.end_gap = select(last_lane, Q(0), sector.end_gap);
        }
        sector.chord = end - outer;
        sector.begin_gap = gap;
        sector.doubled_triangle = det(xy(sector.begin), xy(sector.chord));
        present = (sector.doubled_triangle > Q(0)) &
                  Mask<float, S>::from_bits((std::uint32_t{1} << (count_ - 1)) - 1);
        const Vec3<Q> none{Q(0), Q(0), Q(0)};
        sector.chord = select(present, sector.chord, none);
        sector.begin_gap = select(present, sector.begin_gap, Q(0));
        sector.end_gap = select(present, sector.end_gap, Q(0));
        return sector;
    }

    int count_;
    Vec3<P> vertex_, edge_; ///< scaled and mirrored
    Vec3<float> base_;      ///< vertex 0, scaled and mirrored
    Vec3<P> offset_;        ///< of the vertices from there, accurate relative to the size of the light
    P turn_; ///< of each edge about the zenith: the determinant of its ends in the tangent plane, without sign
    std::uint32_t outer_edges_; ///< their bits
    std::uint32_t
        before_opposite_; ///< bits of the vertices that come before the opposite one; quadrilaterals only
    PolygonHull<float> hull_;
    float inverse_scale_, mirror_;
    bool is_central_, is_ordinary_;
};

NUSSELT_NAMESPACE_END
#endif
