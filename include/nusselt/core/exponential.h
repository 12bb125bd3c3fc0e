#pragma once
/// Powers of cosines with any real exponent, also huge ones.
///
/// The rules are those of trig.h: single precision, scalar or pack, evaluates polynomials with fma; double and long
/// double call the standard library. tests/unit/core/exponential_test.cpp enforces the error bounds.

#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// log((1 + z) / (1 - z)) for z in [0, 1/3].
template <class Real>
NUSSELT_INLINE Real doubled_artanh(const Real& z) noexcept {
    const Real s = z * z;
    Real p = Real(1.0f / 13);
    p = fma(p, s, Real(1.0f / 11));
    p = fma(p, s, Real(1.0f / 9));
    p = fma(p, s, Real(1.0f / 7));
    p = fma(p, s, Real(1.0f / 5));
    p = fma(p, s, Real(1.0f / 3));
    return Real(2) * fma(p * s, z, z);
}

/// The exponent of a power of two from 1 to 2^127. Packs have no integers.
template <class Real>
NUSSELT_INLINE Real exponent_of(Real power) noexcept {
    Real exponent = Real(0);
    NUSSELT_UNROLL
    for (int bit = 6; bit >= 0; --bit) {
        const int step = 1 << bit;
        const auto beyond = power >= Real(power_of_two<scalar_t<Real>>(step));
        power = select(beyond, Real(power_of_two<scalar_t<Real>>(-step)) * power, power);
        exponent = exponent + select(beyond, Real(static_cast<scalar_t<Real>>(step)), Real(0));
    }
    return exponent;
}

/// 2^-exponent for an integer from 0 to 127.
template <class Real>
NUSSELT_INLINE Real reciprocal_power(Real exponent) noexcept {
    Real power = Real(1);
    NUSSELT_UNROLL
    for (int bit = 6; bit >= 0; --bit) {
        const int step = 1 << bit;
        const auto beyond = exponent >= Real(static_cast<scalar_t<Real>>(step));
        power = select(beyond, Real(power_of_two<scalar_t<Real>>(-step)) * power, power);
        exponent = exponent - select(beyond, Real(static_cast<scalar_t<Real>>(step)), Real(0));
    }
    return power;
}

} // namespace detail

/// -log(cosine) of an angle in [0, pi / 2], accurate relative to itself also for small angles; at least 34 and finite
/// for the right angle. Single precision: relative error at most 4e-7 more than what the errors of sine and cosine make.
template <class Real>
NUSSELT_INLINE Real negative_log_of_cosine(const SinCos<Real>& angle) noexcept {
    using Scalar = scalar_t<Real>;
    const Real squared = angle.sin * angle.sin;
    const auto small = squared <= Real(Scalar(0.5));
    if constexpr (kIsSingle<Real>) {
        const Real s = min(squared, Real(0.5f));
        Real result = Real(0.5f) * detail::doubled_artanh(s / (Real(2) - s));
        if (!all(small)) {
            const Real cosine = max(angle.cos, Real(1e-15f));
            const Real power = reciprocal_power_of_two(cosine);
            const Real mantissa = power * cosine;
            const Real fraction = detail::doubled_artanh((mantissa - Real(1)) / (mantissa + Real(1)));
            const Real whole = Real(6.931471806e-1f) * detail::exponent_of(power);
            result = select(small, result, whole - fraction);
        }
        return result;
    } else {
        const Real near = detail::for_each_lane(
            squared, squared, [](auto x, auto) { return std::log1p(-std::fmin(x, decltype(x)(0.5))) / -2; });
        const Real far = detail::for_each_lane(max(angle.cos, Real(Scalar(1e-15))), squared,
                                               [](auto x, auto) { return -std::log(x); });
        return select(small, near, far);
    }
}

/// exp(-x) for x >= 0. Single precision: 0 for x of 87 and more. Single precision: relative error at most 2e-7.
template <class Real>
NUSSELT_INLINE Real exp_of_negative(const Real& x) noexcept {
    if constexpr (kIsSingle<Real>) {
        const auto zero = !(x < Real(87));
        const Real bounded = min(x, Real(87));
        const Real exponent = floor(fma(bounded, Real(1.442695041f), Real(0.5f)));
        // ln(2) as the sum of two floats, the first of which has zeros at its end.
        const Real r = fma(exponent, Real(-3.194618330e-5f), fma(exponent, Real(-0.693115234375f), bounded));
        Real p = Real(-1.0f / 5040);
        p = fma(p, r, Real(1.0f / 720));
        p = fma(p, r, Real(-1.0f / 120));
        p = fma(p, r, Real(1.0f / 24));
        p = fma(p, r, Real(-1.0f / 6));
        p = fma(p, r, Real(0.5f));
        p = fma(p, r, Real(-1));
        p = fma(p, r, Real(1));
        return select(zero, Real(0), p * detail::reciprocal_power(exponent));
    } else {
        return detail::for_each_lane(x, x, [](auto t, auto) { return std::exp(-t); });
    }
}

NUSSELT_NAMESPACE_END
