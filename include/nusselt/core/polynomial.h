#pragma once
/// Polynomials by Horner's scheme in the square of the argument. Its coefficients are pairs of terms, which processors
/// evaluate while they wait for each other, so that the chain of dependent steps is half as long as that of Horner's
/// scheme. Estrin's scheme is as fast but needs higher powers, which become denormal and slow for small arguments.

#include <nusselt/core/real.h>

NUSSELT_NAMESPACE_BEGIN

/// A polynomial at a point, and its divided difference to another point.
template <class Real>
struct DividedDifference {
    Real value; ///< p(x)
    Real slope; ///< (p(y) - p(x)) / (y - x), without cancellation
};

namespace detail {

template <class Coefficients, int i>
inline constexpr auto kCoefficient = Coefficients::coefficient(i);

/// Terms First and above, divided by x^First. First is even.
template <class Coefficients, int First, class Real>
NUSSELT_INLINE Real polynomial_from(const Real& x, const Real& squared) noexcept {
    const Real constant(kCoefficient<Coefficients, First>);
    if constexpr (First + 1 == Coefficients::kTerms) {
        return constant;
    } else {
        const Real pair = multiply_add(Real(kCoefficient<Coefficients, First + 1>), x, constant);
        if constexpr (First + 2 >= Coefficients::kTerms)
            return pair;
        else
            return multiply_add(polynomial_from<Coefficients, First + 2>(x, squared), squared, pair);
    }
}

/// The same with its divided difference: with p = low + x^2 high, that of p is that of low plus y^2 times that of high
/// plus (x + y) high(x).
/// \param sum x + y.
template <class Coefficients, int First, class Real>
NUSSELT_INLINE DividedDifference<Real> difference_from(const Real& x, const Real& x_squared,
                                                       const Real& y_squared, const Real& sum) noexcept {
    const Real constant(kCoefficient<Coefficients, First>);
    if constexpr (First + 1 == Coefficients::kTerms) {
        return {constant, Real(0)};
    } else {
        const Real slope(kCoefficient<Coefficients, First + 1>);
        const Real pair = multiply_add(slope, x, constant);
        if constexpr (First + 2 >= Coefficients::kTerms) {
            return {pair, slope};
        } else {
            const auto high = difference_from<Coefficients, First + 2>(x, x_squared, y_squared, sum);
            const Real low_slope = multiply_add(high.value, sum, slope);
            return {multiply_add(high.value, x_squared, pair),
                    First + 3 == Coefficients::kTerms ? low_slope
                                                      : multiply_add(high.slope, y_squared, low_slope)};
        }
    }
}

} // namespace detail

/// The sum of coefficient(i) x^i.
/// \tparam Coefficients has kTerms and coefficient(i) for i in [0, kTerms).
template <class Coefficients, class Real>
NUSSELT_INLINE Real polynomial(const Real& x) noexcept {
    return detail::polynomial_from<Coefficients, 0>(x, x * x);
}

/// The polynomial at x, and its divided difference to y, which may be x.
template <class Coefficients, class Real>
NUSSELT_INLINE DividedDifference<Real> divided_difference(const Real& x, const Real& y) noexcept {
    return detail::difference_from<Coefficients, 0>(x, x * x, y * y, x + y);
}

NUSSELT_NAMESPACE_END
