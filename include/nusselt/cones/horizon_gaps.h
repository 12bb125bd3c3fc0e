#pragma once
/// How far a horizon is from touching an elliptic cone.

#include <nusselt/core/vec.h>
#include <nusselt/geometry/precise_products.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// (k - |nc|) / k and (k + |nc|) / k with k^2 = na^2 + nb^2, where n. is the product of a length and a height. If all
/// but a sliver of a cone is on one side of the horizon, the digits that rounding takes are all that counts in the
/// first one.
template <class Real>
struct HorizonGaps {
    Real smaller, larger;
};
template <class Real>
NUSSELT_INLINE HorizonGaps<Real> horizon_gaps(const Vec3<Real>& lengths, const Vec3<Real>& heights,
                                              const Real& k) noexcept {
    // Errors of products must not be denormal.
    const Real scale = reciprocal_power_of_two(k);
    const WithError<Real> a = exact_product(scale * lengths.x, heights.x);
    const WithError<Real> b = exact_product(scale * lengths.y, heights.y);
    const WithError<Real> c = exact_product(scale * lengths.z, heights.z);
    const WithError<Real> aa = exact_product(a.value, a.value);
    const WithError<Real> bb = exact_product(b.value, b.value);
    const WithError<Real> cc = exact_product(c.value, c.value);
    const WithError<Real> sum = exact_sum(aa.value, bb.value);
    const WithError<Real> difference = exact_sum(sum.value, -cc.value);
    const Real mixed = a.value * a.error + b.value * b.error - c.value * c.error;
    const Real error = (difference.error + sum.error) + ((aa.error + bb.error) - cc.error) + (mixed + mixed);
    const Real scaled = scale * k, larger = scaled + abs(c.value);
    return {max(difference.value + error, Real(0)) / (larger * scaled), larger / scaled};
}

} // namespace detail

NUSSELT_NAMESPACE_END
