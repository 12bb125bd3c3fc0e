#pragma once
/// Lights scaled to coordinates of order one, so that products of coordinates stay in range.

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// A light with coordinates of order one. The scale is a power of two, so that scaling rounds nothing; directions, solid
/// angles and projected solid angles do not change.
template <class Light, class Real>
struct ScaledLight {
    Light light;
    Real scale;         ///< by which it is larger than the original
    Real inverse_scale; ///< by which the original is larger
};

/// Whether a positive number and its reciprocal are normal numbers.
template <class Real>
NUSSELT_INLINE mask_t<Real> has_reciprocal(const Real& x) noexcept {
    constexpr scalar_t<Real> kSmallest = std::numeric_limits<scalar_t<Real>>::min();
    return (x > Real(kSmallest)) & (x < Real(1 / kSmallest));
}

/// Scales a line or a cylinder, which have scale_of() and scaled().
template <template <class> class Light, class Real>
NUSSELT_INLINE ScaledLight<Light<Real>, Real> to_unit_extent(const Light<Real>& light) noexcept {
    const Real scale = scale_of(light);
    return {scaled(light, scale), scale, reciprocal_power_of_two(scale)};
}

NUSSELT_NAMESPACE_END
