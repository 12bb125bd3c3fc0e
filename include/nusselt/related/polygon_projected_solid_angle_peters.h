#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as
/// printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 3 with the Kahan products and the sorting networks of Sec. 3.7. Scalars walk along both chains of edges
/// instead of sorting, which takes them less time. Use PolygonProjectedSolidAngle instead: this one loses small
/// lights to the difference of two arctangents, and its iteration diverges at some corners on the horizon.

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/related/bitonic_network.h>
#include <nusselt/related/peters_arithmetic.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double.
/// \tparam N    bound on the number of vertices before clipping, 3 to 8.
///
/// Measure and space as PolygonProjectedSolidAngle.
template <class Real, int N>
class PolygonProjectedSolidAnglePeters {
    static constexpr int kSlots = N + 1;
    using Mask = mask_t<Real>;

public:
    /// \param light in shading space, either winding [m].
    explicit PolygonProjectedSolidAnglePeters(const ConvexPolygon<Real, N>& light) noexcept
        : plane_normal_(light.normal),
          plane_distance_(dot(light.normal, light.vertex[0])),
          mirror_(select(plane_distance_ < Real(0), Real(-1), Real(1))) {
        if constexpr (peters::kIsScalar<Real>)
            prepare_by_walking(light);
        else
            prepare_by_sorting(light);
    }

    /// \param u in [0, 1)^2.
    /// \returns the direction alone, as the paper does; sample() adds density and point.
    Vec3<Real> direction(const Vec2<Real>& u) const noexcept {
        Real area = u.x * total_;
        const Sector& s = select_sector(area);
        Vec2<Real> w{Real(0), Real(0)};
        if (any(central_)) w = sample_central(s, area, u.y);
        if (!all(central_)) w = select(central_, w, sample_decentral(s, area, u.y));
        return {w.x, mirror_ * w.y, sqrt(max(Real(1) - dot(w, w), Real(0)))};
    }

    /// \param u in [0, 1)^2.
    LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> wi = direction(u);
        return {wi, wi.z / total_, (plane_distance_ / dot(plane_normal_, wi)) * wi};
    }

    /// Projected solid angle of the part of the light above the horizon [sr].
    Real measure() const noexcept { return total_; }

private:
    /// The region between two ellipses, or between the zenith and the outer one, within an azimuth range.
    struct Sector {
        Vec2<Real> s0, s1; ///< directions to both ends
        Vec2<Real> outer, inner;
        Real area;
    };

    static constexpr int successor(int j, int count) noexcept { return j + 1 < count ? j + 1 : 0; }
    static constexpr int predecessor(int j, int count) noexcept { return j > 0 ? j - 1 : count - 1; }
    /// The ellipse of the plane with normal n.
    static Vec2<Real> ellipse(const Vec3<Real>& n) noexcept { return (Real(1) / n.z) * xy(n); }
    /// (I + u u^T) w.
    static Vec2<Real> times(const Vec2<Real>& u, const Vec2<Real>& w) noexcept { return w + dot(u, w) * u; }
    static Real form(const Vec2<Real>& u, const Vec2<Real>& w) noexcept {
        return dot(w, w) + dot(u, w) * dot(u, w);
    }
    static Real plain_det(const Vec2<Real>& a, const Vec2<Real>& b) noexcept { return a.x * b.y - a.y * b.x; }
    /// Eq. 1.
    NUSSELT_INLINE static Real area_of(const Vec2<Real>& u, const Vec2<Real>& s0,
                                       const Vec2<Real>& s1) noexcept {
        const Real inverse_root = Real(1) / sqrt(Real(1) + dot(u, u));
        return Real(0.5) * inverse_root *
               peters::atan2_positive(plain_det(s0, s1), inverse_root * dot(s0, times(u, s1)));
    }
    /// Eq. 6 for the form with the matrix [[a, b], [b, c]].
    static Vec2<Real> root(const Real& a, const Real& b, const Real& c) noexcept {
        const Real r = sqrt(max(b * b - a * c, Real(0)));
        return select(b >= Real(0), Vec2<Real>{b + r, -a}, Vec2<Real>{c, r - b});
    }

    /// For scalars: as many vertices as there are, with branches.
    void prepare_by_walking(const ConvexPolygon<Real, N>& light) noexcept {
        Vec3<Real> v[kSlots];
        const int m = clip(light, v);
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
            const Vec2<Real> s0 = xy(v[j]), s1 = xy(v[successor(j, m)]), outer = ellipse(n[j]);
            add_sector({s0, s1, outer, {}, area_of(outer, s0, s1)});
        }
    }

    /// \returns the number of vertices
    int clip(const ConvexPolygon<Real, N>& light, Vec3<Real>* v) const noexcept {
        const auto mirrored = [this](const Vec3<Real>& a) { return Vec3<Real>{a.x, mirror_ * a.y, a.z}; };
        int m = 0;
        for (int j = 0; j < N; ++j) {
            const Vec3<Real>& a = light.vertex[j];
            const Vec3<Real>& b = light.vertex[successor(j, N)];
            if (a.z > Real(0) && m < kSlots) v[m++] = mirrored(a);
            if ((a.z > Real(0)) != (b.z > Real(0)) && m < kSlots) {
                const Real t = a.z / (a.z - b.z);
                v[m++] = mirrored({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), Real(0)});
            }
        }
        return m;
    }

    void add_sector(const Sector& sector) noexcept {
        if (!(sector.area > Real(0)) || count_ == kSlots) return;
        sector_[count_++] = sector;
        total_ += sector.area;
    }

    /// The outer edges run forwards from the clockwise end, the inner ones backwards.
    void walk(int m, const Vec3<Real>* v, const Vec3<Real>* n) noexcept {
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
        Vec2<Real> outer = ellipse(n[i]), inner = ellipse(n[k]);
        for (int step = 0; step < 2 * m; ++step) {
            const int next_i = successor(i, m);
            const Vec2<Real> next_outer = xy(v[next_i]);
            const Vec2<Real> next_inner = xy(v[k]);
            const Real order = peters::det(next_outer, next_inner);
            const Vec2<Real> next = order >= Real(0) ? next_outer : next_inner;
            add_sector({s, next, outer, inner, area_of(outer, s, next) - area_of(inner, s, next)});
            s = next;
            if (order >= Real(0)) {
                i = next_i;
                if (!(n[i].z > Real(0))) return;
                outer = ellipse(n[i]);
            }
            if (order <= Real(0)) {
                k = predecessor(k, m);
                if (!(n[k].z < Real(0))) return;
                inner = ellipse(n[k]);
            }
        }
    }

    /// A vertex and the ellipse of the edge that begins there when going counterclockwise.
    struct Event {
        Vec2<Real> s, ellipse;
        Real kind; ///< 1: of an outer edge, -1: of an inner one, 0: no edge begins
    };

    /// For packs: all slots, with selections.
    void prepare_by_sorting(const ConvexPolygon<Real, N>& light) noexcept {
        Vec3<Real> v[N];
        Mask all_above = Mask(true);
        for (int j = 0; j < N; ++j) {
            v[j] = {light.vertex[j].x, mirror_ * light.vertex[j].y, light.vertex[j].z};
            all_above = all_above & (v[j].z > Real(0));
        }
        for (int k = 0; k < kSlots; ++k) sector_[k] = empty_sector();
        if (all(all_above)) {
            find_sectors<N>(v);
        } else {
            Vec3<Real> clipped[kSlots];
            clip_slots(v, clipped);
            find_sectors<kSlots>(clipped);
        }
    }

    /// \param v vertices above the horizon.
    template <int M>
    void find_sectors(const Vec3<Real>* v) noexcept {
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
                const Vec2<Real> s0 = xy(v[k]), s1 = xy(v[successor(k, M)]), outer = ellipse(n[k]);
                const Real area = select(n[k].z > Real(0), area_of(outer, s0, s1), Real(0));
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

    /// The point where an edge meets the horizon.
    static Vec3<Real> crossing(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
        const Real t = a.z / (a.z - b.z);
        return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), Real(0)};
    }

    /// The vertices above the horizon; spare slots repeat vertices.
    static void clip_slots(const Vec3<Real>* vertex, Vec3<Real>* v) noexcept {
        // Each lower vertex becomes the point where the boundary comes up again; the point where it goes down is
        // inserted before the first of them.
        Vec3<Real> down{Real(0), Real(0), Real(0)};
        Vec3<Real> up = down;
        Mask above[N], goes_down[N];
        for (int j = 0; j < N; ++j) above[j] = vertex[j].z > Real(0);
        for (int j = 0; j < N; ++j) {
            const int next = successor(j, N);
            goes_down[j] = above[j] & !above[next];
            const Vec3<Real> point = crossing(vertex[j], vertex[next]);
            down = select(goes_down[j], point, down);
            up = select(above[next] & !above[j], point, up);
        }
        Mask inserted = Mask(false);
        for (int k = 0; k < N; ++k) {
            const Mask insert = goes_down[predecessor(k, N)];
            const int before = k > 0 ? k - 1 : 0;
            const Vec3<Real> kept = select(above[k], vertex[k], up);
            const Vec3<Real> shifted = select(above[before], vertex[before], up);
            v[k] = select(insert, down, select(inserted, shifted, kept));
            inserted = inserted | insert;
        }
        v[N] = select(above[N - 1], vertex[N - 1], up);
    }

    /// Sec. 3.7.
    template <int M>
    void prepare_decentral(const Vec3<Real>* v, const Vec3<Real>* n) noexcept {
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
            event[j] = {xy(v[j]), ellipse(select(is_outer, n[j], before)),
                        select(is_outer, Real(1), select(is_inner, Real(-1), Real(0)))};
            // Both begin at the clockwise end of the polygon.
            const Mask both = is_outer & is_inner;
            if (any(both)) {
                inner = select(both, ellipse(before), inner);
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
            const Real area = area_of(outer, s0, s1) - area_of(inner, s0, s1);
            const Mask present = outer_begun & inner_begun & (area > Real(0));
            sector_[k] = {s0, s1, outer, inner, select(present, area, Real(0))};
        }
    }

    static Event select_event(const Mask& mask, const Event& a, const Event& b) noexcept {
        return {select(mask, a.s, b.s), select(mask, a.ellipse, b.ellipse), select(mask, a.kind, b.kind)};
    }

    /// Scalars read the sector in place, packs blend several.
    using Selected = std::conditional_t<peters::kIsScalar<Real>, const Sector&, Sector>;

    /// \param area in: to be found, out: the part in the sector.
    Selected select_sector(Real& area) const noexcept {
        if constexpr (peters::kIsScalar<Real>) {
            int k = 0;
            while (k + 1 < count_ && area >= sector_[k].area) area -= sector_[k++].area;
            return sector_[k];
        } else {
            Sector s = sector_[0];
            NUSSELT_UNROLL
            for (int k = 1; k < kSlots; ++k) {
                const Sector& next = sector_[k];
                const Mask reached = (next.area > Real(0)) & (area >= s.area);
                area = select(reached, area - s.area, area);
                s = {select(reached, next.s0, s.s0), select(reached, next.s1, s.s1),
                     select(reached, next.outer, s.outer), select(reached, next.inner, s.inner),
                     select(reached, next.area, s.area)};
            }
            return s;
        }
    }

    /// Sec. 3.2.
    static Vec2<Real> sample_central(const Sector& s, const Real& area, const Real& u) noexcept {
        const Real root = sqrt(Real(1) + dot(s.outer, s.outer));
        const Vec2<Real> c = times(s.outer, s.s0);
        const SinCos<Real> angle = peters::sincos_half_turn(Real(2) * root * area);
        const Vec2<Real> w = (root * angle.cos) * s.s0 + angle.sin * Vec2<Real>{-c.y, c.x};
        return sqrt(u / form(s.outer, w)) * w;
    }

    static Vec2<Real> sample_decentral(const Sector& s, const Real& area, const Real& u) noexcept {
        const Vec2<Real> w = invert_decentral(s, area);
        return sqrt((Real(1) - u) / form(s.inner, w) + u / form(s.outer, w)) * w;
    }

    /// Sec. 3.4 and two steps of Sec. 3.3.
    static Vec2<Real> invert_decentral(const Sector& s, const Real& area) noexcept {
        const Vec2<Real> s0 = (Real(1) / sqrt(dot(s.s0, s.s0))) * s.s0;
        const Vec2<Real> s1 = (Real(1) / sqrt(dot(s.s1, s.s1))) * s.s1;
        const Vec2<Real> sh = s0 + s1;
        const auto reach = [](const Vec2<Real>& u, const Vec2<Real>& w) {
            return Real(1) / sqrt(form(u, w));
        };
        const Real i0 = reach(s.inner, s0), ih = reach(s.inner, sh), i1 = reach(s.inner, s1);
        const Real o0 = reach(s.outer, s0), oh = reach(s.outer, sh), o1 = reach(s.outer, s1);
        const Real fraction = min(area / s.area, Real(1));
        const Real quad_0 = o0 * oh - i0 * ih;
        const Real quad_1 = o1 * oh - i1 * ih;
        Real quad_area = fraction * (quad_0 + quad_1) - quad_0;
        const Mask first = quad_area <= Real(0);
        const Vec2<Real> sk = select(first, s0, s1);
        const Real ik = select(first, i0, i1);
        const Real ok = select(first, o0, o1);
        quad_area = select(first, quad_area + quad_0, quad_area - quad_1) * abs(plain_det(sh, sk));
        const Vec2<Real> ri = times(s.inner, ih * sh + ik * sk);
        const Vec2<Real> ro = times(s.outer, oh * sh + ok * sk);
        const Vec2<Real> turned{-sk.y, sk.x};
        const Vec2<Real> p = (ok * oh * dot(ro, sh)) * turned;
        const Vec2<Real> q = (ik * ih * dot(ri, sh)) * turned + quad_area * ri;
        Vec2<Real> w = directed(root(p.x * ri.x - q.x * ro.x,
                                     Real(0.5) * (p.x * ri.y + p.y * ri.x - q.x * ro.y - q.y * ro.x),
                                     p.y * ri.y - q.y * ro.y),
                                sh);
        // At the ends of the sector, the initial value is better than the iteration.
        const Mask iterated = (fraction >= Real(1e-5)) & (fraction <= Real(1 - 1e-5));
        if (!any(iterated)) return w;
        NUSSELT_UNROLL
        for (int k = 0; k < 2; ++k) {
            const Real missing = Real(2) * (area - area_of(s.outer, s0, w) + area_of(s.inner, s0, w));
            const Vec2<Real> ci = times(s.inner, w);
            const Vec2<Real> co = times(s.outer, w);
            const Vec2<Real> gap = ci - co;
            const Vec2<Real> next =
                root(-w.y * gap.x - missing * ci.x * co.x,
                     Real(0.5) * (-w.y * gap.y + w.x * gap.x - missing * (ci.x * co.y + ci.y * co.x)),
                     w.x * gap.y - missing * ci.y * co.y);
            w = select(iterated, directed(next, sh), w);
        }
        return w;
    }

    /// w with the sign of a direction within the sector, normalised in the L1 norm.
    static Vec2<Real> directed(const Vec2<Real>& w, const Vec2<Real>& sh) noexcept {
        const Real inverse = Real(1) / (abs(w.x) + abs(w.y));
        return select(dot(w, sh) < Real(0), -inverse, inverse) * w;
    }

    Vec3<Real> plane_normal_;
    Real plane_distance_;
    Real mirror_;
    Mask central_ = Mask(true);
    int count_ = 0; ///< of the sectors, for scalars; packs have some without area
    Real total_ = Real(0);
    Sector sector_[kSlots];
};

NUSSELT_NAMESPACE_END
