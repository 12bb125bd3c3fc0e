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
    /// \param polygon  clockwise as seen from the origin; outside of its convex hull lies the zenith.
    /// \param distance of the plane of the polygon from the origin: dot(polygon.normal, p) for a point p of it.
    /// \param is_outer whether the great circle of each edge has the zenith on its inner side.
    /// \param is_inner whether it has it on its outer side; neither where circle and zenith meet.
    NUSSELT_HD AzimuthalSweep(const ConvexPolygon<Real, M>& polygon, const Real& distance,
                              const mask_t<Real>* is_outer, const mask_t<Real>* is_inner) noexcept
        : base_(polygon.vertex[0]), normal_(polygon.normal), distance_(distance) {
        const Vec3<Real> zero{Real(0), Real(0), Real(0)};
        first_inner_ = {zero, zero, mask_t<Real>(false)};
        Vec3<Real> offset = zero;
        NUSSELT_UNROLL
        for (int j = 0; j < M; ++j) {
            const int before = j > 0 ? j - 1 : M - 1;
            const Vec3<Real> backward = -polygon.edge[before];
            // At the clockwise end of the polygon an outer and an inner edge begin at the same vertex: the inner
            // one is kept aside.
            const auto both = is_outer[j] & is_inner[before];
            if (any(both)) {
                first_inner_.at = select(both, offset, first_inner_.at);
                first_inner_.rest = select(both, backward, first_inner_.rest);
                first_inner_.begun = first_inner_.begun | both;
            }
            event_[j] = {offset, select(is_outer[j], polygon.edge[j], backward),
                         select(is_outer[j], Real(1), select(is_inner[before], Real(-1), Real(0)))};
            offset = offset + polygon.edge[j];
        }
        sort_bitonic<M>([&](int low, int high) {
            Event& a = event_[low];
            Event& b = event_[high];
            const auto swap = turn(a.offset, b.offset) < Real(0);
            if (!any(swap)) return;
            const Event c = a;
            a = select_event(swap, b, a);
            b = select_event(swap, c, b);
        });
    }

    /// Calls emit(k, sector, present) for k = 0 to M - 2, in counterclockwise order, where any lane has a sector.
    template <class Emit>
    NUSSELT_HD void for_each_sector(Emit emit) const noexcept {
        Chain outer{event_[0].offset, event_[0].edge, event_[0].kind > Real(0)};
        const auto inner_first = event_[0].kind < Real(0);
        Chain inner{select(inner_first, event_[0].offset, first_inner_.at),
                    select(inner_first, event_[0].edge, first_inner_.rest), mask_t<Real>(first_inner_.begun | inner_first)};
        Real gap = Real(0);
        NUSSELT_UNROLL
        for (int k = 1; k < M; ++k) {
            const auto open = outer.begun & inner.begun;
            const Vec3<Real> begin = outer.at;
            const Real begin_gap = gap;
            if (k + 1 < M) {
                pass(event_[k], outer, inner);
            } else {
                advance(outer, crossing(outer, event_[k].offset));
                advance(inner, crossing(inner, event_[k].offset));
            }
            gap = gap_between(outer.at, inner.at);
            DecentralSector<Real> sector;
            sector.begin = point(begin);
            sector.chord = outer.at - begin;
            sector.begin_gap = begin_gap;
            sector.end_gap = gap;
            sector.doubled_triangle = det(xy(sector.begin), xy(sector.chord));
            const auto present = open & (sector.doubled_triangle > Real(0));
            if (any(present)) emit(k - 1, sector, present);
        }
    }

    /// The vertex whose projection to the tangent plane is smaller: it has the smaller rounding error.
    NUSSELT_HD static Vec3<Real> closer_to_zenith(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
        return select(abs(a.x) + abs(a.y) <= abs(b.x) + abs(b.y), a, b);
    }

private:
    /// A vertex and the edge that begins there when going counterclockwise around the zenith. Points are offsets
    /// from vertex 0, accurate relative to the size of the light.
    struct Event {
        Vec3<Real> offset;
        Vec3<Real> edge; ///< counterclockwise
        Real kind;       ///< 1: an outer edge begins, -1: an inner one, 0: neither
    };

    /// Where the sweep is on the outer or the inner edges.
    struct Chain {
        Vec3<Real> at;
        Vec3<Real> rest; ///< of the edge
        mask_t<Real> begun;
    };

    NUSSELT_HD static Event select_event(const mask_t<Real>& mask, const Event& a, const Event& b) noexcept {
        return {select(mask, a.offset, b.offset), select(mask, a.edge, b.edge), select(mask, a.kind, b.kind)};
    }

    /// Above the horizon in spite of rounding.
    NUSSELT_HD Vec3<Real> point(const Vec3<Real>& offset) const noexcept {
        return {base_.x + offset.x, base_.y + offset.y, max(base_.z + offset.z, Real(0))};
    }

    /// det(a, b) of two points in the tangent plane, positive if b lies counterclockwise of a.
    NUSSELT_HD Real turn(const Vec3<Real>& a, const Vec3<Real>& b) const noexcept {
        return det(xy(closer_to_zenith(base_ + a, base_ + b)), xy(b - a));
    }

    /// Whether an edge ends at a larger azimuth than the one that it would replace. Where the edge at an end
    /// of the polygon has practically one azimuth, rounding may sort its ends the wrong way round; it must
    /// not replace the long edge that follows it.
    NUSSELT_HD mask_t<Real> replaces(const Event& next, const Chain& chain) const noexcept {
        return (!chain.begun) | (turn(chain.at + chain.rest, next.offset + next.edge) > Real(0));
    }

    /// Where, as a share of the rest of an edge, it meets the azimuth of a point.
    NUSSELT_HD Real crossing(const Chain& chain, const Vec3<Real>& at) const noexcept {
        const Real slope = det(xy(base_ + at), xy(chain.rest));
        const Real distance = turn(chain.at, at);
        return min(max(distance / select(slope > Real(0), slope, Real(1)), Real(0)), Real(1));
    }

    NUSSELT_HD static void advance(Chain& chain, const Real& x) noexcept {
        chain.at = chain.at + x * chain.rest;
        chain.rest = (Real(1) - x) * chain.rest;
    }

    /// Brings both chains to the azimuth of a vertex, where one of them goes on with another edge.
    NUSSELT_HD void pass(const Event& at, Chain& outer, Chain& inner) const noexcept {
        const auto outer_begins = (at.kind > Real(0)) & replaces(at, outer);
        const auto inner_begins = (at.kind < Real(0)) & replaces(at, inner);
        Chain other{select(outer_begins, inner.at, outer.at), select(outer_begins, inner.rest, outer.rest),
                    mask_t<Real>(true)};
        advance(other, crossing(other, at.offset));
        const Chain new_outer{select(outer_begins, at.offset, other.at),
                              select(outer_begins, at.edge, other.rest), mask_t<Real>(outer.begun | outer_begins)};
        const Chain new_inner{select(outer_begins, other.at, at.offset),
                              select(outer_begins, other.rest, at.edge), mask_t<Real>(inner.begun | inner_begins)};
        // Other vertices are repeated ones, or their azimuth is out of order by rounding.
        const auto begins = outer_begins | inner_begins;
        if (all(begins)) {
            outer = new_outer;
            inner = new_inner;
        } else {
            outer = {select(begins, new_outer.at, outer.at), select(begins, new_outer.rest, outer.rest),
                     new_outer.begun};
            inner = {select(begins, new_inner.at, inner.at), select(begins, new_inner.rest, inner.rest),
                     new_inner.begun};
        }
    }

    /// Height of the plane through the origin and an inner edge above the point of the outer edge that has the
    /// same azimuth. Both points lie in the plane of the polygon, whose distance is a common factor: only the step
    /// between them matters.
    NUSSELT_HD Real gap_between(const Vec3<Real>& outer, const Vec3<Real>& inner) const noexcept {
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
