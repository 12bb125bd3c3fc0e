#pragma once
/// Polynomials by Estrin's scheme: halves of halves, which processors evaluate at once, while each step of Horner's
/// scheme waits for the one before.

#include <nusselt/core/real.h>

NUSSELT_NAMESPACE_BEGIN

/// A polynomial at a point, and its divided difference to another point.
template <class Real>
struct DividedDifference {
    Real value; ///< p(x)
    Real slope; ///< (p(y) - p(x)) / (y - x), without cancellation
};

namespace detail {

/// The powers x^1, x^2, x^4, x^8 and so on, as many as a polynomial of Count terms needs.
template <class Real, int Count>
struct Powers {
    static constexpr int kCount = Count > 16 ? 5 : Count > 8 ? 4 : Count > 4 ? 3 : Count > 2 ? 2 : 1;
    Real power[kCount];
    NUSSELT_HD explicit Powers(const Real& x) noexcept {
        power[0] = x;
        for (int i = 1; i < kCount; ++i) power[i] = power[i - 1] * power[i - 1];
    }
};

/// The logarithm of the number of terms in the lower half: the largest power of two below the count.
constexpr int lower_half(int count) noexcept {
    int log = 0;
    while ((2 << log) < count) ++log;
    return log;
}

template <class Coefficients, int i>
inline constexpr auto kCoefficient = Coefficients::coefficient(i);

/// The sum of coefficient(First + i) x^i for i < Count.
template <class Coefficients, int First, int Count, class Real>
NUSSELT_INLINE Real estrin(const Real* power) noexcept {
    if constexpr (Count == 1) {
        return Real(kCoefficient<Coefficients, First>);
    } else {
        constexpr int kLog = lower_half(Count);
        constexpr int kLow = 1 << kLog;
        return multiply_add(estrin<Coefficients, First + kLow, Count - kLow>(power), power[kLog],
                            estrin<Coefficients, First, kLow>(power));
    }
}

/// The same with the divided difference: with p = low + x^n high, that of p is that of low plus y^n times that of high
/// plus high(x) times that of x^n.
/// \param steps divided differences of x, x^2, x^4 and so on.
template <class Coefficients, int First, int Count, class Real>
NUSSELT_INLINE DividedDifference<Real> estrin(const Real* x, const Real* y, const Real* steps) noexcept {
    if constexpr (Count == 1) {
        return {Real(kCoefficient<Coefficients, First>), Real(0)};
    } else if constexpr (Count == 2) {
        const Real slope(kCoefficient<Coefficients, First + 1>);
        return {multiply_add(slope, x[0], Real(kCoefficient<Coefficients, First>)), slope};
    } else {
        constexpr int kLog = lower_half(Count);
        constexpr int kLow = 1 << kLog;
        const auto low = estrin<Coefficients, First, kLow>(x, y, steps);
        const auto high = estrin<Coefficients, First + kLow, Count - kLow>(x, y, steps);
        Real slope = low.slope;
        if constexpr (Count - kLow > 1) slope = multiply_add(high.slope, y[kLog], slope);
        return {multiply_add(high.value, x[kLog], low.value), multiply_add(high.value, steps[kLog], slope)};
    }
}

} // namespace detail

/// The sum of coefficient(i) x^i.
/// \tparam Coefficients has kTerms and coefficient(i) for i in [0, kTerms).
template <class Coefficients, class Real>
NUSSELT_INLINE Real polynomial(const Real& x) noexcept {
    const detail::Powers<Real, Coefficients::kTerms> powers(x);
    return detail::estrin<Coefficients, 0, Coefficients::kTerms>(powers.power);
}

/// The polynomial at x, and its divided difference to y, which may be x.
template <class Coefficients, class Real>
NUSSELT_INLINE DividedDifference<Real> divided_difference(const Real& x, const Real& y) noexcept {
    using Powers = detail::Powers<Real, Coefficients::kTerms>;
    const Powers of_x(x);
    const Powers of_y(y);
    Real steps[Powers::kCount];
    steps[0] = Real(1);
    for (int i = 1; i < Powers::kCount; ++i)
        steps[i] = i > 1 ? steps[i - 1] * (of_x.power[i - 1] + of_y.power[i - 1]) : x + y;
    return detail::estrin<Coefficients, 0, Coefficients::kTerms>(of_x.power, of_y.power, steps);
}

NUSSELT_NAMESPACE_END
