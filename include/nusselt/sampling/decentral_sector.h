#pragma once
/// Inversion of the area between two ellipses: the azimuth of a sample when the zenith lies outside of the
/// polygon (Peters 2021, polygonal lights, Sec. 3.3 to 3.6).

#include <nusselt/sampling/projected_ellipse.h>

NUSSELT_NAMESPACE_BEGIN

/// The region between two ellipses, counterclockwise from s0 to s1.
template <class Real>
struct DecentralSector {
    Vec2<Real> s0, s1; ///< unit vectors
    ProjectedEllipse<Real> inner, outer;

    /// Twice the area between the ellipses from s0 to w.
    template <class Angles>
    NUSSELT_HD Real doubled_area_to(const Vec2<Real>& w) const noexcept {
        const Real determinant = det(s0, w);
        return max(doubled_sector_area<Angles>(outer, s0, w, determinant) -
                       doubled_sector_area<Angles>(inner, s0, w, determinant),
                   Real(0));
    }

    /// Samples two quads that approximate the sector (Sec. 3.4; the quadratic form re-derives supplement
    /// A.4). \param fraction of the area that shall lie between s0 and the result. \return a direction of
    /// arbitrary length and sign.
    NUSSELT_HD Vec2<Real> initial_direction(const Real& fraction) const noexcept {
        const Vec2<Real> middle = s0 + s1;
        const auto reach = [](const ProjectedEllipse<Real>& l, const Vec2<Real>& s) {
            return Real(1) / sqrt(l.form(s));
        };
        const Real inner_0 = reach(inner, s0), inner_h = reach(inner, middle), inner_1 = reach(inner, s1);
        const Real outer_0 = reach(outer, s0), outer_h = reach(outer, middle), outer_1 = reach(outer, s1);
        // The determinants det(s0, middle) and det(middle, s1) are equal and cancel in the choice of the
        // quad.
        const Real quad_0 = outer_0 * outer_h - inner_0 * inner_h;
        const Real quad_1 = outer_1 * outer_h - inner_1 * inner_h;
        const Real rest = fma(fraction, quad_1, fma(fraction, quad_0, -quad_0));
        const auto first = rest <= Real(0);
        const Vec2<Real> s = select(first, s0, s1);
        const Real inner_s = select(first, inner_0, inner_1);
        const Real outer_s = select(first, outer_0, outer_1);
        const Real doubled_area = (rest + select(first, quad_0, -quad_1)) * abs(det(middle, s));
        // Chords of the ellipses between s and middle: normal r, offset d.
        const Vec2<Real> r_inner = inner.times(inner_h * middle + inner_s * s);
        const Vec2<Real> r_outer = outer.times(outer_h * middle + outer_s * s);
        const Real d_inner = inner_h * dot(r_inner, middle);
        const Real d_outer = outer_h * dot(r_outer, middle);
        const Vec2<Real> turned{-s.y, s.x};
        const Vec2<Real> a = (outer_s * d_outer) * turned;
        const Vec2<Real> b = (inner_s * d_inner) * turned + doubled_area * r_inner;
        return homogeneous_root(a.x * r_inner.x - b.x * r_outer.x,
                                Real(0.5) *
                                    (a.x * r_inner.y + a.y * r_inner.x - b.x * r_outer.y - b.y * r_outer.x),
                                a.y * r_inner.y - b.y * r_outer.y);
    }

    /// One step of the iteration (Sec. 3.3): replaces the ellipses by their tangents at w.
    /// \param missing twice the area that shall lie between w and the result.
    NUSSELT_HD Vec2<Real> step(const Vec2<Real>& w, const Real& missing) const noexcept {
        const Vec2<Real> ci = inner.times(w);
        const Vec2<Real> co = outer.times(w);
        // ci - co without the common part w, which would cancel near the horizon.
        const Vec2<Real> gap = dot(inner.u, w) * inner.u - dot(outer.u, w) * outer.u;
        const Vec2<Real> turned{-w.y, w.x};
        return homogeneous_root(
            turned.x * gap.x - missing * ci.x * co.x,
            Real(0.5) * (turned.x * gap.y + turned.y * gap.x - missing * (ci.x * co.y + ci.y * co.x)),
            turned.y * gap.y - missing * ci.y * co.y);
    }

    /// Turns a homogeneous solution into the half-plane of the sector and brings it to a length of order one
    /// by an exact power of two. Whatever is not a direction becomes `fallback`.
    NUSSELT_HD Vec2<Real> oriented(const Vec2<Real>& w, const Vec2<Real>& fallback) const noexcept {
        const Real extent = abs(w.x) + abs(w.y);
        const auto usable = (extent > Real(0)) & is_finite(extent);
        const Vec2<Real> scaled = select(usable, reciprocal_power_of_two(extent) * w, fallback);
        const Real sign = copysign(Real(1), dot(scaled, s0 + s1));
        return sign * scaled;
    }

    /// The direction w such that the given fraction of the area lies between s0 and w; of order one in
    /// length, within the sector up to rounding.
    ///
    /// The plain iteration diverges where both ellipses meet on the horizon at an end of the sector, which is
    /// usual for polygons that cross the horizon. So the best direction so far is kept, judged by the
    /// residual area; the worst backward error in exact arithmetic is then 4e-5 after two steps. Within 1e-5
    /// of the ends of the sector the start is better than what the iteration makes of it in single precision.
    /// \param doubled_total twice the area of the sector.
    template <int Iterations, class Angles>
    NUSSELT_HD Vec2<Real> direction(const Real& fraction, const Real& doubled_total) const noexcept {
        Vec2<Real> w = oriented(initial_direction(fraction), s0 + s1);
        if constexpr (Iterations > 0) {
            const Real target = fraction * doubled_total;
            const auto near_end = (fraction < Real(1e-5)) | (fraction > Real(1 - 1e-5));
            const Vec2<Real> start = w;
            Vec2<Real> best = w;
            Real best_residual = Real(std::numeric_limits<scalar_t<Real>>::max());
            for (int i = 0;; ++i) {
                const Real missing = target - doubled_area_to<Angles>(w);
                const Real from_s0 = det(s0, w);
                const Real to_s1 = det(w, s1);
                const auto inside = (from_s0 >= Real(0)) & (to_s1 >= Real(0));
                const auto better = inside & (abs(missing) < best_residual);
                best = select(better, w, best);
                best_residual = select(better, abs(missing), best_residual);
                if (i == Iterations) break;
                w = oriented(step(w, missing), best);
            }
            w = select(near_end, start, best);
        }
        return w;
    }
};

NUSSELT_NAMESPACE_END
