#pragma once
/// Trigonometric functions on the ranges that the techniques need.
///
/// Single precision, scalar or pack, evaluates polynomials (minimax, fitted for this library) in the same order, so that
/// scalars and packs give the same bits, and shaders/nusselt the same up to the rounding of the device. Double and long
/// double call the standard library. tests/unit/core/trig_test.cpp enforces the error bounds.

#include <nusselt/core/polynomial.h>

NUSSELT_NAMESPACE_BEGIN

template <class Real>
inline constexpr Real kPi = Real(3.141592653589793238462643383279502884L);

/// Whether Real has single precision and therefore uses polynomials.
template <class Real>
inline constexpr bool kIsSingle = std::is_same_v<scalar_t<Real>, float>;

namespace detail {

/// f(x, y) for scalars, lane by lane for packs.
template <class Real, class Function>
NUSSELT_INLINE Real for_each_lane(const Real& x, const Real& y, Function f) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1) {
        return f(x, y);
    } else {
        Real result = x;
        for (int i = 0; i < RealTraits<Real>::kLanes; ++i) result.set_lane(i, f(x.lane(i), y.lane(i)));
        return result;
    }
}

/// Angles of both quadrants from the arctangent of the ratio smaller / larger of |x| and y.
template <class Real>
NUSSELT_INLINE Real unfold_octants(const Real& y, const Real& x, const Real& octant) noexcept {
    const Real quadrant = select(y > abs(x), Real(kPi<float> / 2) - octant, octant);
    return select(x < Real(0), Real(kPi<float>) - quadrant, quadrant);
}

/// Coefficients of (1 - atan(t) / t) / t^2 as a polynomial in t^2. Float: fitted for t <= 1, relative error 1.1e-6 at
/// most. Others: Taylor series up to tan(pi / 8), each term with 2.5 bits more than the one before.
template <class Scalar>
struct AtanRatio {
    static constexpr int kTerms = std::is_same_v<Scalar, double> ? 20 : 24;
    static constexpr Scalar coefficient(int i) noexcept {
        return (i % 2 == 0 ? Scalar(1) : Scalar(-1)) / static_cast<Scalar>(2 * i + 3);
    }
    static constexpr Scalar kLargest = Scalar(0.1715728752538099L);
};
template <>
struct AtanRatio<float> {
    static constexpr int kTerms = 9;
    static constexpr float coefficient(int i) noexcept {
        constexpr float kFitted[] = {3.33333018e-1f,  -1.99986379e-1f, 1.42652367e-1f,
                                     -1.09575244e-1f, 8.41929077e-2f,  -5.82313878e-2f,
                                     3.14522795e-2f,  -1.10624615e-2f, 1.8267392e-3f};
        return kFitted[i];
    }
    static constexpr float kLargest = 1;
};

/// 1 - atan(t) / t for t beyond the polynomial, where nothing cancels.
template <class Real>
NUSSELT_INLINE Real one_minus_atan_ratio_of_large(const Real& s) noexcept {
    const Real t = sqrt(s);
    const Real angle = for_each_lane(t, t, [](auto x, auto) { return std::atan(x); });
    return Real(1) - angle / t;
}

} // namespace detail

/// 1 - atan(t) / t with full relative precision, given s = t^2 in [0, 1]. Single precision: relative error at
/// most 1.1e-6, absolute at most 5e-8. Its derivative is as smooth as the function: differences of neighbouring
/// values are meaningful.
template <class Real>
NUSSELT_INLINE Real one_minus_atan_ratio(const Real& s) noexcept {
    using Polynomial = detail::AtanRatio<scalar_t<Real>>;
    const Real p = polynomial<Polynomial>(s);
    if constexpr (kIsSingle<Real>) {
        return s * p;
    } else {
        const auto small = s <= Real(Polynomial::kLargest);
        if (all(small)) return s * p;
        return select(small, s * p, detail::one_minus_atan_ratio_of_large(select(small, Real(1), s)));
    }
}

/// A value of one_minus_atan_ratio() and the difference to another one.
template <class Real>
struct AtanRatioDifference {
    Real value;      ///< at s
    Real difference; ///< at s + step minus value, with a small error relative to itself
};

/// \param s, step s and s + step in [0, 1]
template <class Real>
NUSSELT_INLINE AtanRatioDifference<Real> one_minus_atan_ratio_difference(const Real& s,
                                                                         const Real& step) noexcept {
    // The function is s p(s). Its divided difference is p(s) plus the end times that of p.
    using Polynomial = detail::AtanRatio<scalar_t<Real>>;
    const Real end = s + step;
    const auto p = divided_difference<Polynomial>(s, end);
    const Real slope = multiply_add(end, p.slope, p.value);
    if constexpr (kIsSingle<Real>) {
        return {s * p.value, step * slope};
    } else {
        const auto small = max(s, end) <= Real(Polynomial::kLargest);
        if (all(small)) return {s * p.value, step * slope};
        const Real value = one_minus_atan_ratio(s);
        return {value, select(small, step * slope, one_minus_atan_ratio(end) - value)};
    }
}

/// Arctangent of q in [0, 1]. Single precision: relative error at most 3e-7.
template <class Real>
NUSSELT_INLINE Real atan_up_to_one(const Real& q) noexcept {
    if constexpr (kIsSingle<Real>) {
        return multiply_add(-q, one_minus_atan_ratio(q * q), q);
    } else {
        return detail::for_each_lane(q, q, [](auto x, auto) { return std::atan(x); });
    }
}

/// Angle of the point (x, y) with y >= 0, in [0, pi]; 0 for the origin. A negative or NaN y counts as 0.
/// Single precision: relative error at most 3e-7. Finite arguments below 1e38.
template <class Real>
NUSSELT_INLINE Real atan2_positive(const Real& y_in, const Real& x) noexcept {
    const Real y = max(y_in, Real(0));
    if constexpr (kIsSingle<Real>) {
        const Real ax = abs(x);
        const Real large = max(ax, y);
        const Real q = min(ax, y) / select(large > Real(0), large, Real(1));
        return detail::unfold_octants(y, x, atan_up_to_one(q));
    } else {
        return detail::for_each_lane(y, x,
                                     [](auto b, auto a) { return b > 0 || a < 0 ? std::atan2(b, a) : b; });
    }
}

/// Like atan2_positive, but with an absolute error of at most 1.3e-5 rad in every precision: for the biased variant
/// of Peters 2021 (polygonal lights), Sec. 6.4.
template <class Real>
NUSSELT_INLINE Real atan2_positive_fast(const Real& y_in, const Real& x) noexcept {
    const Real y = max(y_in, Real(0));
    const Real ax = abs(x);
    const Real large = max(ax, y);
    const Real q = min(ax, y) / select(large > Real(0), large, Real(1));
    const Real s = q * q;
    Real p = multiply_add(Real(2.0845112e-2f), s, Real(-8.5156346e-2f));
    p = multiply_add(p, s, Real(1.80159291e-1f));
    p = multiply_add(p, s, Real(-3.30304785e-1f));
    p = multiply_add(p, s, Real(9.99866329e-1f));
    return detail::unfold_octants(y, x, p * q);
}

/// Arctangents as precise as the type allows, for templates that can do with less.
struct PreciseAngles {
    template <class Real>
    NUSSELT_HD static Real atan2_positive(const Real& y, const Real& x) noexcept {
        return nusselt::atan2_positive(y, x);
    }
};

/// Arctangents with an error of up to 1.3e-5 rad.
struct FastAngles {
    template <class Real>
    NUSSELT_HD static Real atan2_positive(const Real& y, const Real& x) noexcept {
        return nusselt::atan2_positive_fast(y, x);
    }
};

template <class Real>
struct SinCos {
    Real sin, cos;
};

/// Sine and cosine of an angle in [0, pi]. Single precision: sine with a relative error of at most 2e-7
/// except within 1e-4 of pi, where it is absolute, cosine with an absolute error of at most 1.2e-7.
template <class Real>
NUSSELT_INLINE SinCos<Real> sincos_half_turn(const Real& angle) noexcept {
    if constexpr (kIsSingle<Real>) {
        // r = angle - k pi / 2 in two steps: the first constant has few bits, so that its product is exact.
        const Real k = floor(multiply_add(angle, Real(2 / kPi<float>), Real(0.5f)));
        const Real r = multiply_add(k, Real(-4.83826792e-4f), multiply_add(k, Real(-1.5703125f), angle));
        const Real s = r * r;
        Real ps = multiply_add(Real(-1.95169776e-4f), s, Real(8.33217585e-3f));
        ps = multiply_add(ps, s, Real(-1.66666549e-1f));
        const Real sin_r = multiply_add(r * s, ps, r);
        Real pc = multiply_add(Real(2.44380910e-5f), s, Real(-1.38873645e-3f));
        pc = multiply_add(pc, s, Real(4.16666468e-2f));
        const Real cos_r = multiply_add(s * s, pc, multiply_add(s, Real(-0.5f), Real(1)));
        const mask_t<Real> quarter = abs(k - Real(1)) < Real(0.5f);
        const mask_t<Real> half = k > Real(1.5f);
        return {select(quarter, cos_r, select(half, -sin_r, sin_r)),
                select(quarter, -sin_r, select(half, -cos_r, cos_r))};
    } else {
        return {detail::for_each_lane(angle, angle, [](auto a, auto) { return std::sin(a); }),
                detail::for_each_lane(angle, angle, [](auto a, auto) { return std::cos(a); })};
    }
}

/// Sine and cosine of an angle in [0, pi / 2]. Single precision: sine with a relative error of at most 1.5e-7, cosine
/// with an absolute error of at most 1.2e-7.
template <class Real>
NUSSELT_INLINE SinCos<Real> sincos_quarter_turn(const Real& angle) noexcept {
    if constexpr (kIsSingle<Real>) {
        const Real s = angle * angle;
        const Real s2 = s * s;
        const Real ps = multiply_add(multiply_add(Real(2.608932605e-6f), s, Real(-1.981111272e-4f)), s2,
                                     multiply_add(Real(8.333088167e-3f), s, Real(-1.666666046e-1f)));
        const Real pc = multiply_add(multiply_add(Real(-2.619381449e-7f), s, Real(2.476930420e-5f)), s2,
                                     multiply_add(Real(-1.388856916e-3f), s, Real(4.166665577e-2f)));
        return {multiply_add(angle * s, ps, angle),
                multiply_add(s2, pc, multiply_add(s, Real(-0.5f), Real(1)))};
    } else {
        return sincos_half_turn(angle);
    }
}

namespace detail {

/// Coefficients of (x - sin(x)) / t^3 with x = 2 atan(t) as a polynomial in t^2, fitted on [0, 1], relative error 1.3e-7.
struct AngleMinusSine {
    static constexpr int kTerms = 10;
    static constexpr float coefficient(int i) noexcept {
        constexpr float kFitted[] = {1.33333325f,    -1.59998238f,   1.71369636f, -1.76994431f,
                                     1.7636472f,     -1.61840236f,   1.24713326f, -7.13133872e-1f,
                                     2.57261246e-1f, -4.28121388e-2f};
        return kFitted[i];
    }
};

} // namespace detail

/// x - sin(x) of the angle x = 2 atan(t) in [-pi / 2, pi / 2]. Single precision: relative error at most 6e-7; others: full
/// relative precision.
/// \param t in [-1, 1].
template <class Real>
NUSSELT_INLINE Real angle_minus_sine(const Real& t) noexcept {
    const Real s = t * t;
    if constexpr (kIsSingle<Real>) {
        return t * s * polynomial<detail::AngleMinusSine>(s);
    } else {
        return Real(2) * t * (s / (Real(1) + s) - one_minus_atan_ratio(s));
    }
}

NUSSELT_NAMESPACE_END
