#pragma once
/// Polygons cut into sectors of azimuths, for published methods that first choose an azimuth and then an inclination:
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672, Sec. 3,
/// with the Kahan products and the sorting networks of Sec. 3.7. Arvo's method needs the same sectors (Sec. 3.8).
/// Scalars walk along both chains of edges instead of sorting, which takes them less time.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/related/bitonic_network.h>
#include <nusselt/related/clip_vertices.h>
#include <nusselt/related/peters_arithmetic.h>

NUSSELT_NAMESPACE_BEGIN
namespace peters {

/// The ellipse to which the great circle in the plane with normal n is projected.
template <class Real>
NUSSELT_INLINE Vec2<Real> ellipse(const Vec3<Real>& n) noexcept {
    return (Real(1) / n.z) * xy(n);
}
/// (I + u u^T) w.
template <class Real>
NUSSELT_INLINE Vec2<Real> times(const Vec2<Real>& u, const Vec2<Real>& w) noexcept {
    return w + dot(u, w) * u;
}
/// w^T (I + u u^T) w: one on the ellipse of u.
template <class Real>
NUSSELT_INLINE Real form(const Vec2<Real>& u, const Vec2<Real>& w) noexcept {
    return dot(w, w) + dot(u, w) * dot(u, w);
}
template <class Real>
NUSSELT_INLINE Real plain_det(const Vec2<Real>& a, const Vec2<Real>& b) noexcept {
    return a.x * b.y - a.y * b.x;
}
/// The area of the ellipse of u between two azimuths (Eq. 1).
template <class Real>
NUSSELT_INLINE Real area_of(const Vec2<Real>& u, const Vec2<Real>& s0, const Vec2<Real>& s1) noexcept {
    const Real inverse_root = Real(1) / sqrt(Real(1) + dot(u, u));
    return Real(0.5) * inverse_root *
           peters::atan2_positive(plain_det(s0, s1), inverse_root * dot(s0, times(u, s1)));
}

} // namespace peters

/// The region between two ellipses, or between the zenith and the outer one, within an azimuth range.
template <class Real>
struct AzimuthSector {
    Vec2<Real> s0, s1; ///< directions to both ends
    Vec2<Real> outer, inner;
    Real area;

    /// The area up to the azimuth of w.
    /// \param central whether the sector begins at the zenith instead of the inner ellipse.
    NUSSELT_INLINE Real area_to(const Vec2<Real>& w, const mask_t<Real>& central) const noexcept {
        const Real to_outer = peters::area_of(outer, s0, w);
        if (all(central)) return to_outer;
        return select(central, to_outer, to_outer - peters::area_of(inner, s0, w));
    }
};
template <class Real, class Single>
NUSSELT_HD inline AzimuthSector<Real> broadcast(const AzimuthSector<Single>& s) noexcept {
    return {broadcast<Real>(s.s0), broadcast<Real>(s.s1), broadcast<Real>(s.outer), broadcast<Real>(s.inner),
            Real(s.area)};
}
template <class Real>
NUSSELT_INLINE AzimuthSector<Real> select(const mask_t<Real>& mask, const AzimuthSector<Real>& a,
                                          const AzimuthSector<Real>& b) noexcept {
    return {select(mask, a.s0, b.s0), select(mask, a.s1, b.s1), select(mask, a.outer, b.outer),
            select(mask, a.inner, b.inner), select(mask, a.area, b.area)};
}

/// \tparam Real float, double, long double or a pack of float or double.
/// \tparam N    bound on the number of vertices before clipping, 3 to 8.
///
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
template <class Real, int N>
class AzimuthSectors {
    using Mask = mask_t<Real>;

public:
    static constexpr int kSlots = N + 1;
    using Sector = AzimuthSector<Real>;

    /// To be assigned to before it is used.
    AzimuthSectors() = default;

    /// \param light in shading space, either winding [m].
    NUSSELT_HD explicit AzimuthSectors(const ConvexPolygon<Real, N>& light) noexcept
        : plane_normal_(light.normal),
          plane_distance_(dot(light.normal, light.vertex[0])),
          mirror_(select(plane_distance_ < Real(0), Real(-1), Real(1))) {
        Vec3<Real> v[N];
        for (int j = 0; j < N; ++j)
            v[j] = {light.vertex[j].x, mirror_ * light.vertex[j].y, light.vertex[j].z};
        if constexpr (peters::kIsScalar<Real>) {
            prepare_by_walking(v);
            for (int k = count_; k < kSlots; ++k) sector_[k] = empty_sector();
        } else {
            prepare_by_sorting(v);
        }
        const auto lit = total_ > Real(0);
        inverse_total_ = select(lit, Real(1) / select(lit, total_, Real(1)), Real(0));
    }

    template <class Single>
    NUSSELT_HD explicit AzimuthSectors(const AzimuthSectors<Single, N>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// Where the zenith is in the light, sectors begin there instead of at an inner ellipse.
    NUSSELT_HD const Mask& central() const noexcept { return central_; }
    /// Sector k of kSlots; without area where there is none.
    NUSSELT_HD const Sector& sector(int k) const noexcept { return sector_[k]; }
    /// The number of sectors with area. Packs have gaps between them, so it is kSlots.
    NUSSELT_HD int count() const noexcept { return count_; }

    /// Scalars read the sector in place, packs blend several.
    using Selected = std::conditional_t<peters::kIsScalar<Real>, const Sector&, Sector>;

    /// \param area in: to be found, out: the part in the sector.
    NUSSELT_INLINE Selected select_sector(Real& area) const noexcept {
        return select_sector(area, [](int, const Mask&) {});
    }

    /// \param visit called as visit(k, mask) for what goes with sector k in the lanes of the mask: once for scalars, in
    ///              rising order for packs, whose later calls replace what earlier ones found.
    template <class Visit>
    NUSSELT_INLINE Selected select_sector(Real& area, const Visit& visit) const noexcept {
        if constexpr (peters::kIsScalar<Real>) {
            int k = 0;
            while (k + 1 < count_ && area >= sector_[k].area) area -= sector_[k++].area;
            visit(k, true);
            return sector_[k];
        } else {
            Sector s = sector_[0];
            visit(0, Mask(true));
            NUSSELT_UNROLL
            for (int k = 1; k < kSlots; ++k) {
                const Sector& next = sector_[k];
                const Mask reached = (next.area > Real(0)) & (area >= s.area);
                area = select(reached, area - s.area, area);
                s = select(reached, next, s);
                visit(k, reached);
            }
            return s;
        }
    }

    /// The direction at an azimuth within a sector.
    /// \param w towards the azimuth, of any length.
    /// \param u in [0, 1), uniform in area between both ellipses.
    NUSSELT_INLINE Vec3<Real> direction(const Sector& s, const Vec2<Real>& w, const Real& u) const noexcept {
        Real squared = u / peters::form(s.outer, w);
        if (!all(central_))
            squared = select(central_, squared, squared + (Real(1) - u) / peters::form(s.inner, w));
        return to_hemisphere(sqrt(squared) * w);
    }

    /// The direction above a point in the unit disk.
    NUSSELT_INLINE Vec3<Real> to_hemisphere(const Vec2<Real>& w) const noexcept {
        return {w.x, mirror_ * w.y, sqrt(max(Real(1) - dot(w, w), Real(0)))};
    }

    /// Adds density and point to a direction on the light. Without light, the density is 0.
    NUSSELT_INLINE LightSample<Real> complete(const Vec3<Real>& direction) const noexcept {
        const Vec3<Real> up{Real(0), Real(0), Real(1)};
        const Vec3<Real> wi = select(inverse_total_ > Real(0), direction, up);
        return {wi, wi.z * inverse_total_, (plane_distance_ / dot(plane_normal_, wi)) * wi};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return max(wi.z, Real(0)) * inverse_total_; }

    /// The random numbers for wi, a unit direction on the light: its share of the area in order of azimuths, and the share
    /// of the area between both ellipses in the direction of the azimuth. At the zenith, both are 0.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec2<Real> w{wi.x, mirror_ * wi.y};
        Mask found = inverse_total_ <= Real(0);
        Real before = Real(0);
        Real area = Real(0);
        Real height = Real(0);
        for (int k = 0; k < count_; ++k) {
            const Sector& s = sector_[k];
            // In the decentral case, the order of sectors tells that w is not before one. A direction beyond the last end
            // is there by rounding.
            const Mask begun = (peters::det(s.s0, w) >= Real(0)) | !central_;
            const Mask here = (s.area > Real(0)) & begun & !found;
            const Mask ends = here & (peters::det(w, s.s1) > Real(0));
            const Real part = min(max(s.area_to(w, central_), Real(0)), s.area);
            area = select(here, before + select(ends, part, s.area), area);
            const Real outer = peters::form(s.outer, w);
            const Real inner = peters::form(s.inner, w);
            const Real gap = inner - outer;
            const Real share = outer * (inner - Real(1)) / select(gap > Real(0), gap, Real(1));
            height = select(here, select(central_, outer, share), height);
            found = found | ends;
            before = before + s.area;
        }
        return {below_one(area * inverse_total_), below_one(height)};
    }

    /// Projected solid angle of the part of the light above the horizon [sr].
    NUSSELT_HD Real measure() const noexcept { return total_; }

private:
    static constexpr int successor(int j, int count) noexcept { return j + 1 < count ? j + 1 : 0; }
    static constexpr int predecessor(int j, int count) noexcept { return j > 0 ? j - 1 : count - 1; }

    /// For scalars: as many vertices as there are, with branches.
    NUSSELT_HD void prepare_by_walking(const Vec3<Real>* vertex) noexcept {
        Vec3<Real> v[kSlots];
        const int m = peters::clip_to_outline<N>(vertex, v);
        if (m < 3) return;
        Vec3<Real> n[kSlots];
        bool has_inner = false;
        for (int j = 0; j < m; ++j) {
            n[j] = peters::cross(v[j], v[successor(j, m)]);
            has_inner = has_inner || n[j].z < Real(0);
        }
        central_ = !has_inner;
        if (has_inner) {
            walk(m, v, n);
            return;
        }
        for (int j = 0; j < m; ++j) {
            if (!(n[j].z > Real(0))) continue;
            const Vec2<Real> s0 = xy(v[j]), s1 = xy(v[successor(j, m)]), outer = peters::ellipse(n[j]);
            add_sector({s0, s1, outer, {}, peters::area_of(outer, s0, s1)});
        }
    }

    NUSSELT_HD void add_sector(const Sector& sector) noexcept {
        if (!(sector.area > Real(0)) || count_ == kSlots) return;
        sector_[count_++] = sector;
        total_ += sector.area;
    }

    /// The outer edges run forwards from the clockwise end, the inner ones backwards.
    NUSSELT_HD void walk(int m, const Vec3<Real>* v, const Vec3<Real>* n) noexcept {
        const auto edge_before = [&](int j) {
            int k = predecessor(j, m);
            for (int step = 0; step < m && n[k].z == Real(0); ++step) k = predecessor(k, m);
            return k;
        };
        int i = 0;
        while (i < m && !(n[i].z > Real(0) && n[edge_before(i)].z < Real(0))) ++i;
        if (i == m) return;
        int k = edge_before(i);
        Vec2<Real> s = xy(v[i]);
        Vec2<Real> outer = peters::ellipse(n[i]), inner = peters::ellipse(n[k]);
        for (int step = 0; step < 2 * m; ++step) {
            const int next_i = successor(i, m);
            const Vec2<Real> next_outer = xy(v[next_i]);
            const Vec2<Real> next_inner = xy(v[k]);
            const Real order = peters::det(next_outer, next_inner);
            const Vec2<Real> next = order >= Real(0) ? next_outer : next_inner;
            add_sector(
                {s, next, outer, inner, peters::area_of(outer, s, next) - peters::area_of(inner, s, next)});
            s = next;
            if (order >= Real(0)) {
                i = next_i;
                if (!(n[i].z > Real(0))) return;
                outer = peters::ellipse(n[i]);
            }
            if (order <= Real(0)) {
                k = predecessor(k, m);
                if (!(n[k].z < Real(0))) return;
                inner = peters::ellipse(n[k]);
            }
        }
    }

    /// A vertex and the ellipse of the edge that begins there when going counterclockwise.
    struct Event {
        Vec2<Real> s, ellipse;
        Real kind; ///< 1: of an outer edge, -1: of an inner one, 0: no edge begins
    };

    /// For packs: all slots, with selections.
    NUSSELT_HD void prepare_by_sorting(const Vec3<Real>* v) noexcept {
        Mask all_above = Mask(true);
        for (int j = 0; j < N; ++j) all_above = all_above & (v[j].z > Real(0));
        for (int k = 0; k < kSlots; ++k) sector_[k] = empty_sector();
        count_ = kSlots;
        if (all(all_above)) {
            find_sectors<N>(v);
        } else {
            Vec3<Real> clipped[kSlots];
            peters::clip_to_slots<N>(v, clipped);
            find_sectors<kSlots>(clipped);
        }
    }

    /// \param v vertices above the horizon.
    template <int M>
    NUSSELT_HD void find_sectors(const Vec3<Real>* v) noexcept {
        Vec3<Real> n[M];
        Mask has_inner = Mask(false);
        NUSSELT_UNROLL
        for (int j = 0; j < M; ++j) {
            n[j] = peters::cross(v[j], v[successor(j, M)]);
            has_inner = has_inner | (n[j].z < Real(0));
        }
        central_ = !has_inner;
        if (any(has_inner)) prepare_decentral<M>(v, n);
        if (any(central_)) {
            NUSSELT_UNROLL
            for (int k = 0; k < M; ++k) {
                const Vec2<Real> s0 = xy(v[k]), s1 = xy(v[successor(k, M)]), outer = peters::ellipse(n[k]);
                const Real area = select(n[k].z > Real(0), peters::area_of(outer, s0, s1), Real(0));
                Sector& old = sector_[k];
                old = {select(central_, s0, old.s0), select(central_, s1, old.s1),
                       select(central_, outer, old.outer), old.inner, select(central_, area, old.area)};
            }
        }
        NUSSELT_UNROLL
        for (int k = 0; k < M; ++k) total_ = total_ + sector_[k].area;
    }

    static Sector empty_sector() noexcept {
        const Vec2<Real> zero{Real(0), Real(0)};
        return {zero, zero, zero, zero, Real(0)};
    }

    /// Sec. 3.7.
    template <int M>
    NUSSELT_HD void prepare_decentral(const Vec3<Real>* v, const Vec3<Real>* n) noexcept {
        // Associate each vertex with the ellipse that begins there.
        Event event[M];
        Vec2<Real> outer{Real(0), Real(0)};
        Vec2<Real> inner = outer;
        Mask outer_begun = Mask(false);
        Mask inner_begun = Mask(false);
        NUSSELT_UNROLL
        for (int j = 0; j < M; ++j) {
            const Vec3<Real>& before = n[predecessor(j, M)];
            const Mask is_outer = n[j].z > Real(0);
            const Mask is_inner = before.z < Real(0);
            event[j] = {xy(v[j]), peters::ellipse(select(is_outer, n[j], before)),
                        select(is_outer, Real(1), select(is_inner, Real(-1), Real(0)))};
            // Both begin at the clockwise end of the polygon.
            const Mask both = is_outer & is_inner;
            if (any(both)) {
                inner = select(both, peters::ellipse(before), inner);
                inner_begun = inner_begun | both;
            }
        }

        // Sort by azimuth.
        sort_bitonic<M>([&](int low, int high) {
            Event &a = event[low], &b = event[high];
            const Mask swap = peters::det(a.s, b.s) < Real(0);
            const Event c = a;
            a = select_event(swap, b, a);
            b = select_event(swap, c, b);
        });

        // Pair ellipses and sector boundaries.
        NUSSELT_UNROLL
        for (int k = 0; k < M - 1; ++k) {
            const Mask begins_outer = event[k].kind > Real(0);
            const Mask begins_inner = event[k].kind < Real(0);
            outer = select(begins_outer, event[k].ellipse, outer);
            inner = select(begins_inner, event[k].ellipse, inner);
            outer_begun = outer_begun | begins_outer;
            inner_begun = inner_begun | begins_inner;
            const Vec2<Real>&s0 = event[k].s, &s1 = event[k + 1].s;
            const Real area = peters::area_of(outer, s0, s1) - peters::area_of(inner, s0, s1);
            const Mask present = outer_begun & inner_begun & (area > Real(0));
            sector_[k] = {s0, s1, outer, inner, select(present, area, Real(0))};
        }
    }

    static Event select_event(const Mask& mask, const Event& a, const Event& b) noexcept {
        return {select(mask, a.s, b.s), select(mask, a.ellipse, b.ellipse), select(mask, a.kind, b.kind)};
    }

    Vec3<Real> plane_normal_;
    Real plane_distance_;
    Real mirror_; ///< -1 where y is mirrored, so that the winding is the one that the method wants
    Mask central_ = Mask(true);
    int count_ = 0; ///< of the sectors, for scalars; packs have some without area
    Real total_ = Real(0);
    Real inverse_total_; ///< 0 without light
    Sector sector_[kSlots];

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.plane_normal_, self.plane_distance_, self.mirror_, self.central_, self.count_, self.total_,
              self.inverse_total_, self.sector_);
    }
};

NUSSELT_NAMESPACE_END
