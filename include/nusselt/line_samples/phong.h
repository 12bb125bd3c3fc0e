#pragma once
/// Parts of lines of a planar light, seen in a Phong lobe, by quadrature in constant time.
///
/// Billen and Dutre 2016, Sec. 5.3.2, integrate cos(a) cos(a - a_n) cos(a - a_r)^n over the angle a about the shading
/// point by a recursion over the exponent. Here: Gauss-Legendre quadrature of that smooth function, where it is not
/// negligible. That takes any real exponent and does not cancel where the part is far from the mirrored direction.

#include <nusselt/bsdf/phong.h>
#include <nusselt/core/gauss_legendre.h>
#include <nusselt/line_samples/shading.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// Angles are cut off where the power has fallen by exp(-kDecay) from its largest value on the part. Errors of the
/// quadrature itself are below those of the cut.
template <class Scalar>
struct PhongQuadrature {
    static constexpr int kNodes = 32;
    static constexpr Scalar kDecay = Scalar(25.3L);
};
template <>
struct PhongQuadrature<float> {
    static constexpr int kNodes = 20;
    static constexpr float kDecay = 18.4f;
};

/// The angle, up to pi / 2, beyond which cos(angle)^n is less than exp(-kDecay) times cos(nearest)^n.
/// \param nearest in [0, pi / 2].
template <class Real>
NUSSELT_INLINE Real phong_cut(const Real& exponent, const Real& nearest) noexcept {
    using Scalar = scalar_t<Real>;
    const auto bounded = exponent > Real(Scalar(0.125));
    const Real decay = Real(PhongQuadrature<Scalar>::kDecay) / select(bounded, exponent, Real(1));
    const Real q = exp_of_negative(decay);
    const Real one_minus_q =
        select(decay < Real(Scalar(0.125)),
               decay * fma(decay, fma(decay, Real(Scalar(1) / 6), Real(Scalar(-0.5))), Real(1)), Real(1) - q);
    // The squared sine of half the cut, without a difference of numbers close to 1.
    const Real sine = sincos_quarter_turn(Real(Scalar(0.5)) * nearest).sin;
    const Real squared = min(fma(q * sine, sine, Real(Scalar(0.5)) * one_minus_q), Real(Scalar(0.5)));
    const Real cut = Real(2) * atan2_positive(sqrt(squared), sqrt(Real(1) - squared));
    return select(bounded, cut, Real(kPi<Scalar> / 2));
}

/// Signed angle of the point (x, y), in [-pi, pi].
template <class Real>
NUSSELT_INLINE Real signed_angle(const Real& y, const Real& x) noexcept {
    return copysign(atan2_positive(abs(y), x), y);
}

} // namespace detail

/// Integral of a Phong lobe of albedo 1 over a part of a linear light that is above the surface, per radius.
/// \param e        of the part, in any unit of length: the result is per such unit.
/// \param mirror   unit, in shading space: mirrored(wo).
/// \param exponent 0 or at least 1; any real number. Between 0 and 1, where the lobe has a sharp end, 1e-3 may be lost.
template <class Real>
NUSSELT_HD inline Real phong_integral(const LineExtent<Real>& e, const Vec3<Real>& mirror,
                                      const Real& exponent) noexcept {
    using Scalar = scalar_t<Real>;
    using Quadrature = detail::PhongQuadrature<Scalar>;
    constexpr GaussLegendre<Scalar, Quadrature::kNodes> kRule;
    const Real half_turn = Real(kPi<Scalar>);
    const Real quarter_turn = Real(kPi<Scalar> / 2);
    if (!any(e.visible())) return Real(0);

    // Find the angles from the near end, theta, and from the mirrored direction in the plane of line and origin, u.
    const Vec3<Real> t = e.inverse_distance() * e.line.closest;
    const Real mirror_s = dot(mirror, e.line.inward);
    const Real mirror_t = dot(mirror, t);
    const Real mirror_aside = dot(mirror, cross(e.line.inward, t));
    const Real near_sine = e.near_sine();
    const Real near_cosine = e.near_cosine();
    const Real near_height = e.near_height();
    const Real cos_sweep = e.one_plus_cosine - e.product; // times the product
    const Real sweep = atan2_positive(e.area(), cos_sweep);
    Real u0 = detail::signed_angle(difference_of_products(near_sine, mirror_t, near_cosine, mirror_s),
                                   fma(near_cosine, mirror_t, near_sine * mirror_s));
    u0 = select(u0 > quarter_turn, u0 - Real(2) * half_turn, u0);
    const Real u1 = u0 + sweep;

    // Cut off what is negligible.
    const Real nearest = max(max(u0, -u1), Real(0));
    const Real cut = detail::phong_cut(exponent, min(nearest, quarter_turn));
    const Real skipped = max(-cut - u0, Real(0));
    const Real width = (sweep - skipped) - max(u1 - cut, Real(0));
    const Real u_begin = max(u0, -cut);

    // Find the cosine at the line and with the normal, from their values and derivatives at the near end.
    const Real slope =
        select(cos_sweep > Real(0), (e.far_height() * e.product - near_height * cos_sweep) / e.area(),
               difference_of_products(e.line.inward.z, near_cosine, t.z, near_sine));
    const Real in_plane = sqrt(fma(mirror_s, mirror_s, mirror_t * mirror_t));
    const Real log_aside = negative_log_of_cosine(SinCos<Real>{mirror_aside, in_plane});

    // Integrate over what is left (Billen and Dutre 2016, Eq. 14, with the power of the sine that it lacks).
    Real sum = Real(0);
    for (int i = 0; i < Quadrature::kNodes; ++i) {
        const Real step = Real(kRule.node(i)) * width;
        const SinCos<Real> turn = sincos_half_turn(min(max(skipped + step, Real(0)), half_turn));
        const Real cosine = max(difference_of_products(near_cosine, turn.cos, near_sine, turn.sin), Real(0));
        const Real height = max(fma(slope, turn.sin, near_height * turn.cos), Real(0));
        const Real u = min(abs(u_begin + step), quarter_turn);
        const Real logarithm = log_aside + negative_log_of_cosine(sincos_quarter_turn(u));
        sum = fma(Real(kRule.weight(i)) * cosine, height * exp_of_negative(exponent * logarithm), sum);
    }
    const auto lit = e.visible() & (width > Real(0)) & (mirror.z > Real(0));
    const Real factor = Real(2) * phong_normalisation(exponent) * width * e.inverse_distance();
    return select(lit, factor * sum, Real(0));
}

/// The integral over the part of a segment above the surface [1/m].
/// \param light in shading space [m].
template <class Real>
NUSSELT_HD inline Real phong_integral(const LineSegment<Real>& light, const Vec3<Real>& mirror,
                                      const Real& exponent) noexcept {
    const auto unit = to_safe_extent(light);
    return phong_integral(clipped_extent(unit), mirror, exponent) * unit.scale;
}

/// The contribution of a part of a line of a planar light to a Phong surface [1/m], see shading.h.
/// \param cosine   as for diffuse_part().
/// \param part     with finite ends [m].
/// \param mirror   unit, in shading space: mirrored(wo).
/// \param exponent as for phong_integral().
template <class Real>
NUSSELT_HD inline Real phong_part(const LobeLine<Real>& cosine, const Interval<Real>& part,
                                  const Vec3<Real>& mirror, const Real& exponent) noexcept {
    // The factor of a cosine lobe has 1 / (2 pi distance), and the integral of the Phong lobe has the distance again.
    const Real half_cosine_at_light = Real(kPi<scalar_t<Real>>) * cosine.distance * cosine.factor;
    const LineExtent<Real> e = cosine.extent(cosine.clipped(part));
    return select(e.visible(), half_cosine_at_light * phong_integral(e, mirror, exponent), Real(0));
}

NUSSELT_NAMESPACE_END
