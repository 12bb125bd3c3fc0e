#pragma once
/// Great circles through the edges of a polygon, projected to the tangent plane of the surface.

#include <nusselt/core/trig.h>
#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// The ellipse q^T (I + u u^T) q = 1 that the great circle with normal n projects to, with u = n.xy / n.z
/// (Peters 2021, polygonal lights, Sec. 3.1).
template <class Real>
struct ProjectedEllipse {
    Vec2<Real> u;

    /// The matrix C = I + u u^T times a vector.
    NUSSELT_HD Vec2<Real> times(const Vec2<Real>& w) const noexcept {
        const Real projected = dot(u, w);
        return {fma(projected, u.x, w.x), fma(projected, u.y, w.y)};
    }
    /// w^T C w: the ellipse meets the ray along w at w / sqrt(w^T C w).
    NUSSELT_HD Real form(const Vec2<Real>& w) const noexcept {
        const Real projected = dot(u, w);
        return fma(projected, projected, dot(w, w));
    }
    /// 1 / sqrt(det C), also the cosine between the plane of the great circle and the tangent plane.
    NUSSELT_HD Real inverse_root_determinant() const noexcept { return Real(1) / sqrt(Real(1) + dot(u, u)); }
};

template <class Real>
NUSSELT_HD inline ProjectedEllipse<Real> select(const mask_t<Real>& mask, const ProjectedEllipse<Real>& a,
                                                const ProjectedEllipse<Real>& b) noexcept {
    return {select(mask, a.u, b.u)};
}

/// Precise arctangents.
struct PreciseAngles {
    template <class Real>
    NUSSELT_HD static Real atan2_positive(const Real& y, const Real& x) noexcept {
        return nusselt::atan2_positive(y, x);
    }
};

/// Arctangents with an error of 1.3e-5 rad.
struct FastAngles {
    template <class Real>
    NUSSELT_HD static Real atan2_positive(const Real& y, const Real& x) noexcept {
        return nusselt::atan2_positive_fast(y, x);
    }
};

/// Twice the area of an ellipse within the sector from s0 counterclockwise to s1, at most half a turn (Peters
/// 2021, polygonal lights, Prop. 1). Lengths of s0 and s1 do not matter.
/// \param determinant det(s0, s1), which the caller may know more accurately; clamped at 0.
template <class Angles, class Real>
NUSSELT_HD inline Real doubled_sector_area(const ProjectedEllipse<Real>& ellipse, const Vec2<Real>& s0,
                                           const Vec2<Real>& s1, const Real& determinant) noexcept {
    const Real w = ellipse.inverse_root_determinant();
    return w * Angles::atan2_positive(determinant, w * dot(s0, ellipse.times(s1)));
}

/// The root of x^T Q x = 0, Q = [[a, b], [b, c]], that depends continuously on the coefficients, as
/// homogeneous vector of arbitrary length and sign (Blinn 2006; Peters 2021, polygonal lights, Eq. 6). A
/// negative discriminant counts as 0.
template <class Real>
NUSSELT_HD inline Vec2<Real> homogeneous_root(const Real& a, const Real& b, const Real& c) noexcept {
    const Real root = sqrt(max(fma(b, b, -a * c), Real(0)));
    const auto positive = b >= Real(0);
    return {select(positive, b + root, c), select(positive, -a, root - b)};
}

NUSSELT_NAMESPACE_END
