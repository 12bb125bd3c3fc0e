#pragma once
/// Grids in front of a flat light, which keep its radiance to directions near its normal. The share that they pass depends on
/// the direction only, so that WindowedPolygon can sample such lights: make a table of share times radiance for domain().
/// Only a rectangle around the foot of a shading point is not black to it, and the light is cut to that rectangle.

#include <nusselt/core/gauss_legendre.h>
#include <nusselt/emission/rectified_table.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// Slopes of holes that tables can represent.
template <class T>
NUSSELT_HD inline T hole_slope(const T& slope) noexcept {
    return min(max(slope, T(1) / kLargestSlope<T>), kLargestSlope<T>);
}

} // namespace detail

/// A honeycomb with rectangular holes: the share (1 - |x| / (s z)) (1 - |y| / (t z)) of a hole is visible in direction (x, y, z).
template <class T>
struct Honeycomb {
    Vec2<T> slope; ///< width over depth of the holes, s and t; clamped to 1 / kLargestSlope and kLargestSlope

    /// The share of radiance that passes in a unit direction of the frame of the light, whose z axis is its normal.
    NUSSELT_HD T share(const Vec3<T>& direction) const noexcept {
        const auto along = [&](const T& x, const T& s) {
            return max(T(1) - abs(x) / (direction.z * detail::hole_slope(s)), T(0));
        };
        return direction.z > T(0) ? along(direction.x, slope.x) * along(direction.y, slope.y) : T(0);
    }

    /// The share of the flux of a Lambertian light that passes: divide by it to keep the power. Integrated in closed form over
    /// x, it is 2 / pi times the integral of (1 - tan(b) / t) atan(s cos b) cos b over b from 0 to atan(t), which is smooth.
    NUSSELT_HD T flux_share() const noexcept {
        constexpr int kNodes = 16;
        constexpr GaussLegendre<T, kNodes> kRule;
        const T s = detail::hole_slope(slope.x);
        const T t = detail::hole_slope(slope.y);
        const T end = std::atan(t);
        T mean = T(0);
        for (int i = 0; i < kNodes; ++i) {
            const T b = end * kRule.node(i);
            const T cosine = std::cos(b);
            mean += kRule.weight(i) * max(T(1) - T(std::tan(b)) / t, T(0)) * std::atan(s * cosine) * cosine;
        }
        return T(2 / kPi<T>) * end * mean;
    }

    NUSSELT_HD RectifiedDomain<T> domain() const noexcept {
        const Vec2<T> s{detail::hole_slope(slope.x), detail::hole_slope(slope.y)};
        return {{-s.x, -s.y}, s};
    }
};

/// The same share in all azimuths, 1 - tan(angle from the normal) / t: what Cycles calls spread.
template <class T>
struct RadialSpread {
    T slope; ///< t, from which on nothing passes; clamped to 1 / kLargestSlope and kLargestSlope

    /// \copydoc Honeycomb::share
    NUSSELT_HD T share(const Vec3<T>& direction) const noexcept {
        const T across = sqrt(direction.x * direction.x + direction.y * direction.y);
        return direction.z > T(0) ? max(T(1) - across / (direction.z * detail::hole_slope(slope)), T(0))
                                  : T(0);
    }

    /// The share of the flux of a Lambertian light that passes, 1 - atan(t) / t: divide by it to keep the power.
    NUSSELT_HD T flux_share() const noexcept {
        const T t = detail::hole_slope(slope);
        return t < T(1) ? one_minus_atan_ratio(t * t) : T(1) - T(std::atan(t)) / t;
    }

    /// The square around the disc of slopes.
    NUSSELT_HD RectifiedDomain<T> domain() const noexcept { return Honeycomb<T>{{slope, slope}}.domain(); }
};

NUSSELT_NAMESPACE_END
