#pragma once
/// A clamp that stays positive, for weights.

#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// About the mean of max(0, X) for a normal X: (mean + sqrt(mean^2 + 2 variance / pi)) / 2. Exact if the mean or the
/// variance is 0, at most 12 % too large for means above minus half of the deviation, and too large below. Positive if
/// the variance is.
template <class Real>
NUSSELT_INLINE Real smooth_clamp(const Real& mean, const Real& variance) noexcept {
    using T = scalar_t<Real>;
    const Real root = sqrt(multiply_add(mean, mean, Real(2 / kPi<T>) * variance));
    const Real sum = root + abs(mean);
    // Where the mean is negative, the sum would cancel.
    const auto positive = mean >= Real(0);
    return select(positive, Real(T(0.5)) * sum, Real(1 / kPi<T>) * variance / select(positive, Real(1), sum));
}

NUSSELT_NAMESPACE_END
