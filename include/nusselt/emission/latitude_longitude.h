#pragma once
/// Directions of images in latitudes and longitudes, to resample them to octahedral maps.

#include <nusselt/core/trig.h>
#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// The unit direction at a point of the image: the upper edge is the zenith +z, the lower edge is -z. Azimuths begin at
/// +x and turn towards +y. In an image of m rows, each texel of row j has the solid angle
/// 2 pi / columns (cos(pi j / m) - cos(pi (j + 1) / m)).
/// \param at in [0, 1]^2.
template <class Real>
NUSSELT_HD inline Vec3<Real> latitude_longitude_direction(const Vec2<Real>& at) noexcept {
    constexpr auto kHalfTurn = kPi<scalar_t<Real>>;
    const SinCos<Real> polar = sincos_half_turn(Real(kHalfTurn) * at.y);
    const Real half_turns = Real(2) * at.x;
    const auto second = half_turns >= Real(1);
    const SinCos<Real> azimuth =
        sincos_half_turn(Real(kHalfTurn) * (half_turns - select(second, Real(1), Real(0))));
    const Real across = select(second, -polar.sin, polar.sin);
    return {across * azimuth.cos, across * azimuth.sin, polar.cos};
}

/// The point of the image for a direction, in [0, 1)^2. At the poles, the column is the first or the middle one.
/// \param w unit.
template <class Real>
NUSSELT_HD inline Vec2<Real> latitude_longitude_coordinates(const Vec3<Real>& w) noexcept {
    constexpr auto kHalfTurn = kPi<scalar_t<Real>>;
    const Real turns = Real(1 / (2 * kHalfTurn)) * atan2_positive(abs(w.y), w.x);
    const Real polar = atan2_positive(sqrt(w.x * w.x + w.y * w.y), w.z);
    return {below_one(select(w.y < Real(0), Real(1) - turns, turns)), below_one(Real(1 / kHalfTurn) * polar)};
}

NUSSELT_NAMESPACE_END
