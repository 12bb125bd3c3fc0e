#pragma once
/// Uniform sampling of spherical triangles, as published: the building block of polygon_solid_angle_arvo.h and of
/// polygon_subdivision_urena.h.
///
/// J. Arvo 1995, Stratified Sampling of Spherical Triangles, SIGGRAPH 95, doi:10.1145/218380.218500. Solid angles are those of
/// A. van Oosterom and J. Strackee 1983, The Solid Angle of a Plane Triangle, IEEE Transactions on Biomedical Engineering
/// BME-30(2), doi:10.1109/TBME.1983.325207, instead of sums of angles less pi; angles themselves are not needed, only their
/// sines and cosines.

#include <nusselt/related/peters_arithmetic.h>

NUSSELT_NAMESPACE_BEGIN

/// A spherical triangle with the vertices a, b and c of the paper. Samples lie on arcs from b to the edge from a to c.
template <class Real>
struct SphericalTriangleArvo {
    Vec3<Real> a, b;
    Vec3<Real> tangent;        ///< at a, towards c
    Real cos_alpha, sin_alpha; ///< of the angle at a
    Real cos_b, cos_c;         ///< of the lengths of the edges from a to c and to b
    Real solid_angle;          ///< 0 for triangles without area

    /// Uninitialised: to be assigned to before it is used.
    SphericalTriangleArvo() = default;

    /// \param a_in, b_in, c_in unit vectors, in either winding.
    NUSSELT_INLINE SphericalTriangleArvo(const Vec3<Real>& a_in, const Vec3<Real>& b_in,
                                         const Vec3<Real>& c_in) noexcept
        : a(a_in), b(b_in), cos_b(dot(a_in, c_in)), cos_c(dot(a_in, b_in)) {
        const Vec3<Real> to_b = peters::cross(a, b_in);
        const Vec3<Real> to_c = peters::cross(a, c_in);
        // The product of to_b with a is zero up to rounding. Without it, small triangles keep more digits.
        const Real volume = abs(dot(to_b, c_in - a));
        const Real squared = dot(to_c, to_c);
        const Real product = sqrt(dot(to_b, to_b) * squared);
        const auto present = product > Real(0);
        const Real inverse = Real(1) / select(present, product, Real(1));
        cos_alpha = inverse * dot(to_b, to_c);
        sin_alpha = inverse * volume;
        tangent = (Real(1) / sqrt(select(present, squared, Real(1)))) * peters::cross(to_c, a);
        const Real cosines = Real(1) + cos_c + cos_b + dot(b_in, c_in);
        solid_angle = Real(2) * peters::atan2_positive(volume, cosines);
    }

    template <class Single>
    NUSSELT_HD explicit SphericalTriangleArvo(const SphericalTriangleArvo<Single>& s) noexcept
        : a(broadcast<Real>(s.a)),
          b(broadcast<Real>(s.b)),
          tangent(broadcast<Real>(s.tangent)),
          cos_alpha(s.cos_alpha),
          sin_alpha(s.sin_alpha),
          cos_b(s.cos_b),
          cos_c(s.cos_c),
          solid_angle(s.solid_angle) {}

    /// The direction up to whose arc the triangle has a solid angle.
    /// \param part solid angle [sr], from 0 to solid_angle.
    /// \param u in [0, 1), moves along the arc.
    NUSSELT_INLINE Vec3<Real> direction(const Real& part, const Real& u) const noexcept {
        // Sine and cosine of part - alpha; the solid angle can exceed a half turn.
        const SinCos<Real> half = peters::sincos_half_turn(Real(0.5) * part);
        const Real sin_part = Real(2) * half.sin * half.cos;
        const Real cos_part = half.cos * half.cos - half.sin * half.sin;
        const Real s = sin_part * cos_alpha - cos_part * sin_alpha;
        const Real t = cos_part * cos_alpha + sin_part * sin_alpha;
        const Real x = t - cos_alpha; // u and v of the paper
        const Real y = s + sin_alpha * cos_c;
        const Real quotient = ((y * t - x * s) * cos_alpha - y) / ((y * s + x * t) * sin_alpha);
        // Rounding must not move the end of the arc away from the edge. Where it leaves 0 / 0, the sample is at a.
        const Real q = max(min(quotient, Real(1)), cos_b);
        const Vec3<Real> end = q * a + sqrt(max((Real(1) - q) * (Real(1) + q), Real(0))) * tangent;
        // Along the arc, the cosine of the angle from b is uniform.
        const Real end_cosine = dot(end, b);
        const Real z = Real(1) - u * (Real(1) - end_cosine);
        const Real rise = sqrt(max(u * (Real(1) + z) / (Real(1) + end_cosine), Real(0)));
        return (z - rise * end_cosine) * b + rise * end;
    }

    /// Where a direction is in the triangle.
    struct Place {
        Real part; ///< as in direction(), at most solid_angle
        Real u;    ///< as in direction(); 0 at b
        mask_t<Real>
            behind; ///< whether the arc from b through the direction leaves the triangle's edge to a behind
    };

    /// \param side 1 or -1, the sign of the triple product of a, b and c.
    NUSSELT_HD Place place_of(const Vec3<Real>& wi, const Real& side) const noexcept {
        // The plane of the arc meets that of the edge from a to c in a direction with these coordinates along a and the
        // tangent. Before a, a itself will do.
        const Vec3<Real> n = side * peters::cross(wi, b);
        const Real y = -dot(n, a);
        const mask_t<Real> behind = (y > Real(0)) & (solid_angle > Real(0));
        const Real x = select(behind, dot(n, tangent), Real(1));
        const Real rise = select(behind, y, Real(0));
        const Real inverse = Real(1) / sqrt(x * x + rise * rise);
        const Vec3<Real> end = (inverse * x) * a + (inverse * rise) * tangent;

        const Real volume = inverse * rise * abs(dot(peters::cross(a, b), tangent));
        const Real cosines = Real(1) + cos_c + inverse * x + dot(b, end);
        const Vec3<Real> to_wi = wi - b;
        const Vec3<Real> to_end = end - b;
        const Real squared = dot(to_end, to_end);
        return {min(Real(2) * peters::atan2_positive(volume, cosines), solid_angle),
                dot(to_wi, to_wi) / select(squared > Real(0), squared, Real(1)), behind};
    }
};

template <class Real>
NUSSELT_INLINE SphericalTriangleArvo<Real> select(const mask_t<Real>& mask,
                                                  const SphericalTriangleArvo<Real>& x,
                                                  const SphericalTriangleArvo<Real>& y) noexcept {
    SphericalTriangleArvo<Real> result;
    result.a = select(mask, x.a, y.a);
    result.b = select(mask, x.b, y.b);
    result.tangent = select(mask, x.tangent, y.tangent);
    result.cos_alpha = select(mask, x.cos_alpha, y.cos_alpha);
    result.sin_alpha = select(mask, x.sin_alpha, y.sin_alpha);
    result.cos_b = select(mask, x.cos_b, y.cos_b);
    result.cos_c = select(mask, x.cos_c, y.cos_c);
    result.solid_angle = select(mask, x.solid_angle, y.solid_angle);
    return result;
}

NUSSELT_NAMESPACE_END
