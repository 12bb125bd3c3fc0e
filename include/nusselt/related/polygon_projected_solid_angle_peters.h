#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as
/// printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 3 with the Kahan products of Sec. 3.7; pairing by walking both chains of edges instead of a sorting
/// network, as suits scalar code. Use PolygonProjectedSolidAngle instead: this one loses small lights to the
/// difference of two arctangents, and its iteration diverges at some corners on the horizon.

#include <cmath>

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double or long double.
/// \tparam N    bound on the number of vertices before clipping.
///
/// Measure and space as PolygonProjectedSolidAngle.
template <class Real, int N>
class PolygonProjectedSolidAnglePeters {
public:
    /// \param light in shading space, either winding [m].
    explicit PolygonProjectedSolidAnglePeters(const ConvexPolygon<Real, N>& light) noexcept {
        plane_ = {light.normal, dot(light.normal, light.vertex[0])};
        mirror_ = plane_.distance < Real(0) ? Real(-1) : Real(1);
        Vec3<Real> v[N + 1];
        const int m = clip(light, v);
        if (m < 3) return;
        for (int j = 0; j < m; ++j) v[j].y *= mirror_;
        Vec3<Real> n[N + 1];
        bool has_inner = false;
        for (int j = 0; j < m; ++j) {
            n[j] = cross(v[j], v[(j + 1) % m]);
            has_inner = has_inner || n[j].z < Real(0);
        }
        central_ = !has_inner;
        if (central_) {
            for (int j = 0; j < m; ++j)
                if (n[j].z > Real(0)) add_sector(xy(v[j]), xy(v[(j + 1) % m]), slope(n[j]), Vec2<Real>{});
        } else {
            walk(m, v, n);
        }
    }

    /// \param u in [0, 1)^2.
    /// \returns the direction alone, as the paper does; sample() adds density and point.
    Vec3<Real> direction(const Vec2<Real>& u) const noexcept {
        Real area = u.x * total_;
        int k = 0;
        while (k + 1 < count_ && area >= sector_[k].area) area -= sector_[k++].area;
        const Sector& s = sector_[k];
        Vec2<Real> w;
        if (central_) {
            const Real root = sqrt(Real(1) + dot(s.outer, s.outer));
            const Vec2<Real> c = times(s.outer, s.s0);
            const Real angle = Real(2) * root * area;
            w = (root * std::cos(angle)) * s.s0 + std::sin(angle) * Vec2<Real>{-c.y, c.x};
            w = sqrt(u.y / form(s.outer, w)) * w;
        } else {
            w = invert_decentral(s, area);
            const Real squared = (Real(1) - u.y) / form(s.inner, w) + u.y / form(s.outer, w);
            w = sqrt(squared) * w;
        }
        return {w.x, mirror_ * w.y, sqrt(max(Real(1) - dot(w, w), Real(0)))};
    }

    /// \param u in [0, 1)^2.
    LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> wi = direction(u);
        return {wi, wi.z / total_, (plane_.distance / dot(plane_.normal, wi)) * wi};
    }

    /// Projected solid angle of the part of the light above the horizon [sr].
    Real measure() const noexcept { return total_; }

private:
    struct Plane {
        Vec3<Real> normal;
        Real distance;
    };
    struct Sector {
        Vec2<Real> s0, s1, outer, inner;
        Real area;
    };

    static Vec2<Real> slope(const Vec3<Real>& n) noexcept { return (Real(1) / n.z) * xy(n); }
    /// (I + u u^T) w.
    static Vec2<Real> times(const Vec2<Real>& u, const Vec2<Real>& w) noexcept { return w + dot(u, w) * u; }
    static Real form(const Vec2<Real>& u, const Vec2<Real>& w) noexcept {
        return dot(w, w) + dot(u, w) * dot(u, w);
    }
    /// Eq. 1.
    static Real area_of(const Vec2<Real>& u, const Vec2<Real>& s0, const Vec2<Real>& s1) noexcept {
        const Real inverse_root = Real(1) / sqrt(Real(1) + dot(u, u));
        return Real(0.5) * inverse_root *
               std::atan2(max(det(s0, s1), Real(0)), inverse_root * dot(s0, times(u, s1)));
    }
    /// Eq. 6 for the form with the matrix [[xx, xy], [xy, yy]].
    static Vec2<Real> root(const Real& xx, const Real& xy, const Real& yy) noexcept {
        const Real r = sqrt(max(xy * xy - xx * yy, Real(0)));
        return xy >= Real(0) ? Vec2<Real>{xy + r, -xx} : Vec2<Real>{yy, r - xy};
    }

    static int clip(const ConvexPolygon<Real, N>& light, Vec3<Real>* v) noexcept {
        int m = 0;
        for (int j = 0; j < N; ++j) {
            const Vec3<Real>& a = light.vertex[j];
            const Vec3<Real>& b = light.vertex[(j + 1) % N];
            if (a.z > Real(0) && m <= N) v[m++] = a;
            if ((a.z > Real(0)) != (b.z > Real(0)) && m <= N) {
                const Real t = a.z / (a.z - b.z);
                v[m++] = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), Real(0)};
            }
        }
        return m;
    }

    void add_sector(const Vec2<Real>& s0, const Vec2<Real>& s1, const Vec2<Real>& outer,
                    const Vec2<Real>& inner) noexcept {
        Real area = area_of(outer, s0, s1);
        if (!central_) area -= area_of(inner, s0, s1);
        if (!(area > Real(0)) || count_ > N) return;
        sector_[count_++] = {s0, s1, outer, inner, area};
        total_ += area;
    }

    /// The outer edges run forwards from the clockwise end, the inner ones backwards.
    void walk(int m, const Vec3<Real>* v, const Vec3<Real>* n) noexcept {
        int i = -1;
        for (int j = 0; j < m; ++j) {
            int k = (j + m - 1) % m;
            for (int step = 0; step < m && n[k].z == Real(0); ++step) k = (k + m - 1) % m;
            if (n[j].z > Real(0) && n[k].z < Real(0)) i = j;
        }
        if (i < 0) return;
        int k = (i + m - 1) % m;
        while (n[k].z == Real(0)) k = (k + m - 1) % m;
        Vec2<Real> s = xy(v[i]);
        for (int step = 0; step < 2 * m && n[i].z > Real(0) && n[k].z < Real(0); ++step) {
            const Vec2<Real> next_outer = xy(v[(i + 1) % m]);
            const Vec2<Real> next_inner = xy(v[k]);
            const Real order = det(next_outer, next_inner);
            const Vec2<Real> next = order >= Real(0) ? next_outer : next_inner;
            add_sector(s, next, slope(n[i]), slope(n[k]));
            s = next;
            if (order >= Real(0)) i = (i + 1) % m;
            if (order <= Real(0)) k = (k + m - 1) % m;
        }
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
        const bool first = quad_area <= Real(0);
        const Vec2<Real> sk = first ? s0 : s1;
        const Real ik = first ? i0 : i1;
        const Real ok = first ? o0 : o1;
        quad_area = (first ? quad_area + quad_0 : quad_area - quad_1) * abs(det(sh, sk));
        const Vec2<Real> ri = times(s.inner, ih * sh + ik * sk);
        const Vec2<Real> ro = times(s.outer, oh * sh + ok * sk);
        const Vec2<Real> turned{-sk.y, sk.x};
        const Vec2<Real> p = (ok * oh * dot(ro, sh)) * turned;
        const Vec2<Real> q = (ik * ih * dot(ri, sh)) * turned + quad_area * ri;
        Vec2<Real> w =
            root(p.x * ri.x - q.x * ro.x, Real(0.5) * (p.x * ri.y + p.y * ri.x - q.x * ro.y - q.y * ro.x),
                 p.y * ri.y - q.y * ro.y);
        const int iterations = fraction < Real(1e-5) || fraction > Real(1 - 1e-5) ? 0 : 2;
        for (int k = 0;; ++k) {
            if (dot(w, sh) < Real(0)) w = Real(-1) * w;
            w = (Real(1) / (abs(w.x) + abs(w.y))) * w;
            if (k == iterations) return w;
            const Real missing = Real(2) * (area - area_of(s.outer, s0, w) + area_of(s.inner, s0, w));
            const Vec2<Real> ci = times(s.inner, w);
            const Vec2<Real> co = times(s.outer, w);
            const Vec2<Real> gap = ci - co;
            w = root(-w.y * gap.x - missing * ci.x * co.x,
                     Real(0.5) * (-w.y * gap.y + w.x * gap.x - missing * (ci.x * co.y + ci.y * co.x)),
                     w.x * gap.y - missing * ci.y * co.y);
        }
    }

    Plane plane_{};
    Real mirror_ = 1;
    bool central_ = true;
    int count_ = 0;
    Real total_ = 0;
    Sector sector_[N + 1] = {};
};

NUSSELT_NAMESPACE_END
