#pragma once
/// Arithmetic of the published formulas of Peters 2021, as fast as the target allows: what a user would write who
/// does without the guarantees of core/trig.h and core/vec.h.

#include <cmath>
#include <type_traits>

#include <nusselt/core/trig.h>
#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN
namespace peters {

inline constexpr bool kHasFma = NUSSELT_HAS_FMA;
template <class Real>
inline constexpr bool kIsScalar = RealTraits<Real>::kLanes == 1;

/// a * b - c * d by Kahan's algorithm, as the paper wants it, if fma is an instruction. Otherwise scalars compute in double,
/// which is as accurate, and packs do without.
template <class Real>
NUSSELT_INLINE Real difference_of_products(const Real& a, const Real& b, const Real& c,
                                           const Real& d) noexcept {
    if constexpr (!kHasFma && std::is_same_v<Real, float>)
        return static_cast<float>(double{a} * double{b} - double{c} * double{d});
    else if constexpr (kIsScalar<Real>)
        return nusselt::difference_of_products(a, b, c, d);
    else if constexpr (kHasFma)
        return fma(a, b, -(c * d)) - fma(c, d, -(c * d));
    else
        return a * b - c * d;
}
template <class Real>
NUSSELT_INLINE Real det(const Vec2<Real>& a, const Vec2<Real>& b) noexcept {
    return peters::difference_of_products(a.x, b.y, a.y, b.x);
}
template <class Real>
NUSSELT_INLINE Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {peters::difference_of_products(a.y, b.z, a.z, b.y),
            peters::difference_of_products(a.z, b.x, a.x, b.z),
            peters::difference_of_products(a.x, b.y, a.y, b.x)};
}

/// Angle of the point (x, y) with y >= 0; a negative y counts as 0. In float, the polynomial has a relative error of
/// 1.2e-7 and, by Estrin's scheme, short chains; it is 1.1 to 1.5 times as fast as std::atan2.
template <class Real>
NUSSELT_INLINE Real atan2_positive(const Real& y_in, const Real& x) noexcept {
    if constexpr (kIsSingle<Real>) {
        const Real y = max(y_in, Real(0));
        const Real ax = abs(x);
        const Real q = min(ax, y) / max(ax, y);
        const Real s = q * q, s2 = s * s;
        const auto pair = [&](float c0, float c1) { return multiply_add(Real(c1), s, Real(c0)); };
        const Real low =
            multiply_add(pair(0.199669618f, -0.140032902f), s2, pair(0.999999882f, -0.333318127f));
        const Real high =
            multiply_add(pair(0.0237805186f, -0.00455979199f), s2, pair(0.0986886546f, -0.0588297531f));
        const Real octant = q * multiply_add(high, s2 * s2, low);
        const Real quadrant = select(y > ax, Real(kPi<float> / 2) - octant, octant);
        return select(x < Real(0), Real(kPi<float>) - quadrant, quadrant);
    } else {
        return nusselt::atan2_positive(y_in, x);
    }
}

/// \param w_t cosine of the arcsine of w_s. The standard library is faster, but has no packs.
template <class Real>
NUSSELT_INLINE Real arcsine(const Real& w_s, const Real& w_t) noexcept {
    if constexpr (kIsScalar<Real>)
        return std::asin(w_s);
    else
        return copysign(peters::atan2_positive(abs(w_s), w_t), w_s);
}

/// Of angles in [-pi / 2, pi / 2]. In float, the polynomials of sincos_quarter_turn() in shorter chains; they are up to
/// 1.2 times as fast as the standard library.
template <class Real>
NUSSELT_INLINE SinCos<Real> sincos_around_zero(const Real& x) noexcept {
    if constexpr (kIsSingle<Real>) {
        const Real s = x * x, s2 = s * s;
        const auto pair = [&](float c0, float c1) { return multiply_add(Real(c1), s, Real(c0)); };
        const Real ps = multiply_add(pair(8.333088167e-3f, -1.981111272e-4f), s, Real(-1.666666046e-1f));
        const Real sine = multiply_add(Real(2.608932605e-6f), s2 * s, ps);
        const Real pc = multiply_add(pair(-1.388856916e-3f, 2.476930420e-5f), s, Real(4.166665577e-2f));
        const Real cosine = multiply_add(Real(-2.619381449e-7f), s2 * s, pc);
        return {multiply_add(x * s, sine, x),
                multiply_add(s2, cosine, multiply_add(s, Real(-0.5f), Real(1)))};
    } else {
        const SinCos<Real> positive = sincos_quarter_turn(abs(x));
        return {copysign(positive.sin, x), positive.cos};
    }
}

/// Of angles in [0, pi].
template <class Real>
NUSSELT_INLINE SinCos<Real> sincos_half_turn(const Real& angle) noexcept {
    const Real folded = min(angle, Real(kPi<scalar_t<Real>>) - angle);
    const SinCos<Real> result = sincos_around_zero(folded);
    return {result.sin, select(folded < angle, -result.cos, result.cos)};
}

} // namespace peters
NUSSELT_NAMESPACE_END
