#pragma once
/// Cuts a polygon beside the zenith into sectors at the azimuths of its vertices, each bounded by one outer and
/// one inner edge (Peters 2021, polygonal lights, Sec. 3.7). Differences to the paper: positions on edges are
/// offsets from one vertex, so that they stay accurate relative to the size of the polygon, and both edges of a
/// sector are related by the plane of the polygon, so that the distance between them stays accurate where the
/// polygon is seen edge-on.

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/sorting_network.h>
#include <nusselt/sampling/decentral_sector.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam M number of vertices.
template <class Real, int M>
class AzimuthalSweep {
public:
    /// \param polygon  clockwise as seen from the origin, beside the zenith.
    /// \param distance of the plane of the polygon from the origin: dot(polygon.normal, p) for a point p of it.
    NUSSELT_HD AzimuthalSweep(const ConvexPolygon<Real, M>& polygon, const Real& distance) noexcept
        : normal_(polygon.normal), distance_(distance) {
        Vec3<Real> offset[M];
        Azimuth azimuth[M];
        const auto is_vague = find_azimuths(polygon, offset, azimuth) > Real(kVague);
        if (!any(is_vague)) {
            begin_edges(polygon, offset, azimuth);
        } else {
            // A vertex next to the zenith has a definite azimuth only if it is vertex 0, whose offset is not rounded.
            const ConvexPolygon<Real, M> turned = turned_to_zenith(polygon, is_vague);
            find_azimuths(turned, offset, azimuth);
            begin_edges(turned, offset, azimuth);
        }

        // Sort the vertices by their azimuth.
        sort_by_network<M>([&](int low, int high) {
            Event& a = event_[low];
            Event& b = event_[high];
            // At equal azimuths, outer edges come first, so that the result does not depend on the network.
            const auto swap = (b.azimuth < a.azimuth) | ((b.azimuth == a.azimuth) & (b.kind > a.kind));
            if (!any(swap)) return;
            const Event c = a;
            a = select_event(swap, b, a);
            b = select_event(swap, c, b);
        });
    }

    /// Calls emit(k, sector, present) for k = 0 to M - 2, in counterclockwise order, with the lanes that have a sector.
    template <class Emit>
    NUSSELT_HD void for_each_sector(Emit emit) const noexcept {
        // Start both chains of edges at the clockwise end of the polygon.
        Chain outer{event_[0].offset, event_[0].edge, event_[0].kind > Real(0)};
        const auto inner_first = event_[0].kind < Real(0);
        Chain inner{select(inner_first, event_[0].offset, first_inner_.at),
                    select(inner_first, event_[0].edge, first_inner_.rest),
                    mask_t<Real>(first_inner_.begun | inner_first)};

        // Advance from vertex to vertex; between two of them, both chains bound a sector.
        Real gap = Real(0);
        NUSSELT_UNROLL
        for (int k = 1; k < M; ++k) {
            const auto open = outer.begun & inner.begun;
            const Vec3<Real> begin = outer.at;
            const Real begin_gap = gap;
            if (k + 1 < M) {
                pass(event_[k], outer, inner, gap);
            } else {
                // Both chains end at the last azimuth.
                outer.at = outer.at + outer.rest;
                inner.at = inner.at + inner.rest;
                gap = end_gap(outer.at, inner.at);
            }
            DecentralSector<Real> sector;
            sector.begin = point(begin);
            sector.chord = outer.at - begin;
            sector.begin_gap = begin_gap;
            sector.end_gap = gap;
            sector.doubled_triangle = det(xy(sector.begin), xy(sector.chord));
            emit(k - 1, sector, open & (sector.doubled_triangle > Real(0)));
        }
    }

    /// The vertex whose projection to the tangent plane is smaller: it has the smaller rounding error.
    NUSSELT_HD static Vec3<Real> closer_to_zenith(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
        return select(abs(a.x) + abs(a.y) <= abs(b.x) + abs(b.y), a, b);
    }

private:
    static constexpr scalar_t<Real> kRounding = 4 * std::numeric_limits<scalar_t<Real>>::epsilon();
    /// Rounding of an azimuth above which a vertex is next to the zenith: closer than a thousandth of the size in float.
    static constexpr scalar_t<Real> kVague = power_of_two<scalar_t<Real>>(-11);

    /// A vertex and the edge that begins there when going counterclockwise around the zenith. Points are offsets
    /// from vertex 0, accurate relative to the size of the light.
    struct Event {
        Real azimuth;
        Vec3<Real> offset;
        Vec3<Real> edge; ///< counterclockwise
        Real kind;       ///< 1: an outer edge begins, -1: an inner one, 0: neither
    };

    /// Azimuth of a vertex relative to vertex 0, by a measure of angles that grows with them, and its error.
    struct Azimuth {
        Real angle, rounding;
    };

    NUSSELT_HD Azimuth azimuth_of(const Vec3<Real>& vertex, const Vec3<Real>& offset,
                                  const Real& reach) const noexcept {
        const Real sine = det(xy(base_), xy(offset));
        const Real cosine = dot(xy(base_), xy(vertex));
        const Real sum = abs(sine) + abs(cosine);
        const Real inverse = Real(1) / select(sum > Real(0), sum, Real(1));
        const Real ratio = sine * inverse;
        const Real size = (abs(base_.x) + abs(base_.y)) * reach;
        return {select(cosine < Real(0), copysign(Real(2), sine) - ratio, ratio),
                Real(kRounding) * inverse * size};
    }

    /// Measures the azimuth of each vertex relative to vertex 0, which becomes the base.
    /// \param offset, azimuth become those of the vertices.
    /// \returns the largest rounding error of an azimuth.
    NUSSELT_INLINE Real find_azimuths(const ConvexPolygon<Real, M>& polygon, Vec3<Real>* offset,
                                      Azimuth* azimuth) noexcept {
        base_ = polygon.vertex[0];
        offset[0] = {Real(0), Real(0), Real(0)};
        azimuth[0] = {Real(0), Real(0)};
        Real reach = Real(0); // of the sums of edges, which rounding of the offsets is proportional to
        Real rounding = Real(0);
        NUSSELT_UNROLL
        for (int j = 1; j < M; ++j) {
            offset[j] = offset[j - 1] + polygon.edge[j - 1];
            reach = max(reach, abs(offset[j].x) + abs(offset[j].y));
            azimuth[j] = azimuth_of(polygon.vertex[j], offset[j], reach);
            rounding = max(rounding, azimuth[j].rounding);
        }
        return rounding;
    }

    /// The same polygon, in the lanes of `where` with the vertex that is closest to the zenith first.
    NUSSELT_HD static ConvexPolygon<Real, M> turned_to_zenith(const ConvexPolygon<Real, M>& polygon,
                                                              const mask_t<Real>& where) noexcept {
        Real turns = Real(0); // by how many vertices
        Real least = abs(polygon.vertex[0].x) + abs(polygon.vertex[0].y);
        for (int j = 1; j < M; ++j) {
            const Real reach = abs(polygon.vertex[j].x) + abs(polygon.vertex[j].y);
            const auto is_closer = reach < least;
            turns = select(where & is_closer, Real(j), turns);
            least = min(least, reach);
        }
        ConvexPolygon<Real, M> turned = polygon;
        for (int k = 0; k < M - 1; ++k) {
            const auto turns_on = turns > Real(k);
            if (!any(turns_on)) break;
            const Vec3<Real> first_vertex = turned.vertex[0], first_edge = turned.edge[0];
            for (int j = 0; j < M; ++j) {
                const Vec3<Real> next_vertex = j + 1 < M ? turned.vertex[j + 1] : first_vertex;
                const Vec3<Real> next_edge = j + 1 < M ? turned.edge[j + 1] : first_edge;
                turned.vertex[j] = select(turns_on, next_vertex, turned.vertex[j]);
                turned.edge[j] = select(turns_on, next_edge, turned.edge[j]);
            }
        }
        return turned;
    }

    /// Associates each vertex with the edge that begins there in counterclockwise order (Sec. 3.7).
    NUSSELT_INLINE void begin_edges(const ConvexPolygon<Real, M>& polygon, const Vec3<Real>* offset,
                                    Azimuth* azimuth) noexcept {
        // Edges that have one azimuth as far as rounding can tell are neither outer nor inner ones. With exactly equal
        // azimuths they do not disturb the order of the others. In both directions, for runs of such edges.
        auto uncertain = is_close(azimuth[0], azimuth[M - 1]);
        NUSSELT_UNROLL
        for (int j = 1; j < M; ++j) uncertain = uncertain | is_close(azimuth[j], azimuth[j - 1]);
        if (any(uncertain)) unite_all(azimuth);

        first_inner_ = {offset[0], offset[0], mask_t<Real>(false)};
        NUSSELT_UNROLL
        for (int j = 0; j < M; ++j) {
            const int before = j > 0 ? j - 1 : M - 1;
            const int after = j + 1 < M ? j + 1 : 0;
            const auto is_outer = azimuth[after].angle > azimuth[j].angle;
            const auto is_inner = azimuth[before].angle > azimuth[j].angle;
            const Vec3<Real> backward = -polygon.edge[before];
            // At the clockwise end of the polygon an outer and an inner edge begin at the same vertex: the inner
            // one is kept aside.
            const auto both = is_outer & is_inner;
            if (any(both)) {
                first_inner_.at = select(both, offset[j], first_inner_.at);
                first_inner_.rest = select(both, backward, first_inner_.rest);
                first_inner_.begun = first_inner_.begun | both;
            }
            event_[j] = {azimuth[j].angle, offset[j], select(is_outer, polygon.edge[j], backward),
                         select(is_outer, Real(1), select(is_inner, Real(-1), Real(0)))};
        }
    }

    NUSSELT_INLINE static mask_t<Real> is_close(const Azimuth& a, const Azimuth& b) noexcept {
        return abs(a.angle - b.angle) <= max(a.rounding, b.rounding);
    }

    /// Makes azimuths of neighbours equal if they are so up to rounding: the less certain one takes over the other. That
    /// of a vertex next to the zenith, which is hardly known, does not bridge those of its neighbours so.
    NUSSELT_HD static void unite(Azimuth& a, Azimuth& b) noexcept {
        const auto close = is_close(a, b);
        const auto a_moves = close & (a.rounding >= b.rounding);
        const auto b_moves = close & (a.rounding < b.rounding);
        const Azimuth old = a;
        a = {select(a_moves, b.angle, a.angle), select(a_moves, b.rounding, a.rounding)};
        b = {select(b_moves, old.angle, b.angle), select(b_moves, old.rounding, b.rounding)};
    }
    NUSSELT_HD static void unite_all(Azimuth* azimuth) noexcept {
        for (int j = 1; j < M; ++j) unite(azimuth[j], azimuth[j - 1]);
        unite(azimuth[0], azimuth[M - 1]);
        for (int j = M - 1; j > 0; --j) unite(azimuth[j - 1], azimuth[j]);
    }

    /// The position of the sweep on the outer or the inner edges.
    struct Chain {
        Vec3<Real> at;
        Vec3<Real> rest; ///< of the edge
        mask_t<Real> begun;
    };

    NUSSELT_HD static Event select_event(const mask_t<Real>& mask, const Event& a, const Event& b) noexcept {
        return {select(mask, a.azimuth, b.azimuth), select(mask, a.offset, b.offset),
                select(mask, a.edge, b.edge), select(mask, a.kind, b.kind)};
    }

    /// Above the horizon in spite of rounding.
    NUSSELT_HD Vec3<Real> point(const Vec3<Real>& offset) const noexcept {
        return {base_.x + offset.x, base_.y + offset.y, max(base_.z + offset.z, Real(0))};
    }

    /// Brings both chains to the azimuth of a vertex, where one of them continues with another edge.
    /// \param gap becomes that between both chains; see end_gap().
    NUSSELT_HD void pass(const Event& at, Chain& outer, Chain& inner, Real& gap) const noexcept {
        const auto outer_begins = at.kind > Real(0);
        const auto inner_begins = at.kind < Real(0);
        const Vec3<Real> from = select(outer_begins, inner.at, outer.at);
        const Vec3<Real> along = select(outer_begins, inner.rest, outer.rest);

        // Intersect the other chain with the azimuth.
        const Vec3<Real> vertex = base_ + at.offset;
        const Vec3<Real> start = base_ + from;
        const Vec3<Real> step = at.offset - from;
        const Real way = det(xy(closer_to_zenith(start, vertex)), xy(step)); // positive: counterclockwise
        const Real slope = det(xy(vertex), xy(along));
        const Real safe_slope = select(slope > Real(0), slope, Real(1));
        const Real x = min(max(way / safe_slope, Real(0)), Real(1));
        const Vec3<Real> other = from + x * along;
        const Vec3<Real> rest = (Real(1) - x) * along;

        const Real turn = det(xy(closer_to_zenith(start, start + along)), xy(along));
        const AzimuthOnEdge<Real> azimuth{xy(vertex), along, step, way, slope};
        const Real new_gap = azimuth.gap(normal_, distance_, select(outer_begins, -turn, safe_slope));

        // No edge begins at repeated vertices and at ends of edges with one azimuth.
        const auto begins = outer_begins | inner_begins;
        if (all(begins)) {
            outer.at = select(outer_begins, at.offset, other);
            outer.rest = select(outer_begins, at.edge, rest);
            inner.at = select(outer_begins, other, at.offset);
            inner.rest = select(outer_begins, rest, at.edge);
            gap = new_gap;
        } else {
            outer.at = select(outer_begins, at.offset, select(inner_begins, other, outer.at));
            outer.rest = select(outer_begins, at.edge, select(inner_begins, rest, outer.rest));
            inner.at = select(inner_begins, at.offset, select(outer_begins, other, inner.at));
            inner.rest = select(inner_begins, at.edge, select(outer_begins, rest, inner.rest));
            gap = select(begins, new_gap, gap);
        }
        outer.begun = outer.begun | outer_begins;
        inner.begun = inner.begun | inner_begins;
    }

    /// Height of the plane through the origin and an inner edge above the point of the outer edge that has the
    /// same azimuth. Both points lie in the plane of the polygon, whose distance is a common factor: only the step
    /// between them matters.
    NUSSELT_HD Real end_gap(const Vec3<Real>& outer, const Vec3<Real>& inner) const noexcept {
        const Vec3<Real> outward = outer - inner;
        const Vec2<Real> azimuth = xy(base_) + xy(inner);
        const Real upright = normal_.z * dot(azimuth, azimuth);
        const Real level = dot(xy(normal_), azimuth);
        // The larger component of the normal within the vertical plane of this azimuth.
        const auto flat = normal_.z * upright >= level * level;
        const Real numerator = distance_ * select(flat, dot(xy(outward), azimuth), -outward.z);
        const Real denominator = select(flat, upright, level);
        return max(numerator / select(denominator != Real(0), denominator, Real(1)), Real(0));
    }

    Event event_[M];
    Chain first_inner_;
    Vec3<Real> base_;
    Vec3<Real> normal_;
    Real distance_;
};

NUSSELT_NAMESPACE_END
