#pragma once
/// The cycloid x - sin(x) and its inverse: the distribution of the angle from a pole on the horizon, weighted by the
/// cosine at the surface. Both are accurate relative to themselves, for angles of any size.

#include <nusselt/core/trig.h>
#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// Cube root of x in [0, 20]. Single precision: relative error at most 3e-7 above 1e-6 and 3e-6 above 1e-9, absolute
/// error at most 2e-4 below.
template <class Real>
NUSSELT_INLINE Real cube_root(const Real& x) noexcept {
    if constexpr (kIsSingle<Real>) {
        // x^(5/16) is close enough for two steps of Halley's method.
        const Real fourth = sqrt(sqrt(x));
        Real r = Real(0.86f) * fourth * sqrt(sqrt(fourth));
        NUSSELT_UNROLL
        for (int i = 0; i < 2; ++i) {
            const Real cube = r * r * r;
            const Real denominator = cube + cube + x;
            r = r * ((cube + (x + x)) / select(denominator > Real(0), denominator, Real(1)));
        }
        return r;
    } else {
        return detail::for_each_lane(x, x, [](auto a, auto) { return std::cbrt(a); });
    }
}

namespace detail {

/// The inverse of the cycloid over its argument z = cbrt(6 y), as a polynomial in z^2, fitted for y <= pi; relative
/// error 8e-8.
struct InverseCycloid {
    static constexpr int kTerms = 9;
    static constexpr float coefficient(int i) noexcept {
        constexpr float kFitted[] = {1.00000008f,    1.66649979e-2f,  7.20078958e-4f,
                                     3.19933824e-5f, 7.53784436e-6f,  -1.64838031e-6f,
                                     3.80596054e-7f, -3.92543666e-8f, 1.95707355e-9f};
        return kFitted[i];
    }
};

} // namespace detail

/// (x - sin(x)) / t^3 with x = 2 angle and t = tan(angle), or over sin(angle)^3 above 45 degrees.
template <class Real>
struct CycloidRatio {
    Real value;
    mask_t<Real> is_small; ///< whether it is over the tangent
};

/// \param sine, cosine of an angle in [0, pi); exactly the angle that is given as well.
template <class Real>
NUSSELT_INLINE CycloidRatio<Real> cycloid_ratio(const Real& angle, const Real& sine,
                                                const Real& cosine) noexcept {
    const auto small = sine < cosine;
    const Real t = select(small, sine, Real(0)) / select(small, cosine, Real(1));
    const Real s = t * t;
    Real near;
    if constexpr (kIsSingle<Real>) {
        near = polynomial<detail::AngleMinusSine>(s);
    } else {
        const auto tiny = s < Real(kTiny<scalar_t<Real>>);
        const Real safe = select(tiny, Real(1), s);
        near = select(tiny, Real(4) / Real(3),
                      Real(2) * (Real(1) / (Real(1) + s) - one_minus_atan_ratio(safe) / safe));
    }
    const Real cube = sine * sine * sine;
    const Real far = Real(2) * (angle - sine * cosine) / select(cube > Real(0), cube, Real(1));
    return {select(small, near, far), mask_t<Real>(small)};
}

/// x - sin(x) for x = 2 angle, as a fraction of x^3 / 6, in [0.15, 1].
template <class Real>
NUSSELT_INLINE Real cycloid_fraction(const Real& angle, const Real& sine, const Real& cosine) noexcept {
    const CycloidRatio<Real> ratio = cycloid_ratio(angle, sine, cosine);
    const Real t = select(ratio.is_small, sine / select(ratio.is_small, cosine, Real(1)), sine);
    const Real per_angle = t / select(angle > Real(0), angle, Real(1));
    return select(angle > Real(0), Real(0.75) * ratio.value * per_angle * per_angle * per_angle, Real(1));
}

/// The angle for which 2 angle - sin(2 angle) is u times that of the largest angle.
/// \param largest  in [0, pi).
/// \param fraction cycloid_fraction() of it.
template <class Real>
NUSSELT_INLINE Real inverse_cycloid(const Real& u, const Real& largest, const Real& fraction) noexcept {
    constexpr scalar_t<Real> pi = kPi<scalar_t<Real>>;
    const Real x_largest = largest + largest;
    const Real y = u * fraction * (x_largest * x_largest * x_largest); // six times
    const auto upper = y > Real(6 * pi);
    const Real rest = max(Real(12 * pi) - y, Real(0));
    const Real z = cube_root(select(upper, rest, u * fraction)) * select(upper, Real(1), x_largest);
    Real x = z * polynomial<detail::InverseCycloid>(z * z);
    if constexpr (!kIsSingle<Real>) {
        const Real goal = select(upper, rest, y);
        NUSSELT_UNROLL
        for (int i = 0; i < 2; ++i) {
            const auto half = sincos_half_turn(Real(0.5) * x);
            const Real value = cycloid_fraction(Real(0.5) * x, half.sin, half.cos) * (x * x * x);
            x = x - detail::for_each_lane(value - goal, Real(12) * half.sin * half.sin,
                                          [](auto d, auto slope) { return slope > 0 ? d / slope : d; });
        }
    }
    return min(Real(0.5) * select(upper, Real(2 * pi) - x, x), largest);
}

NUSSELT_NAMESPACE_END
