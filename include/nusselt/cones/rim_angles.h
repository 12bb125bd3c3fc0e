#pragma once
/// Angles around the rim of an elliptic cone in which densities of sweeps are smooth.
///
/// Derived here (docs/techniques/elliptic_cone.md). The angle is that from a point of the rim, the reference. Distances
/// of the rim from the origin have singularities at complex angles: a squeeze of the disk moves them away. Rays that
/// almost reach the antipode of a pole turn quickly: a stretch of half-angles turns with them.

#include <nusselt/cones/elliptic_cone.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// 1 minus the cosine of an angle in [0, pi), relative to itself.
template <class Real>
NUSSELT_INLINE Real versine(const Real& sine, const Real& cosine) noexcept {
    const auto forwards = cosine > Real(0);
    return select(forwards, sine * sine, Real(1) - cosine) / select(forwards, Real(1) + cosine, Real(1));
}

} // namespace detail

/// \tparam Real float, double, long double or a pack.
template <class Real>
struct RimAngles {
    /// A point of the rim.
    struct Point {
        Vec2<Real> scaled;   ///< in the disk, times a length
        Real inverse_length; ///< of that
        Real across; ///< the sine of the angle in the disk from the reference, accurate relative to itself
        Real inverse_norm; ///< one over the squared length of (x, s), see at()
        Real jacobian;     ///< angle in the disk per angle of the map
    };

    Real squeeze, stretch;
    Vec2<Real> mid;  ///< the reference after the squeeze, of unit length
    Real mid_length; ///< by which the squeeze makes it longer

    RimAngles() = default;

    /// The stretch is up to set_stretch().
    /// \param a, b, c   of the cone, c > 0
    /// \param reference of unit length, in the disk.
    NUSSELT_HD RimAngles(const Real& a, const Real& b, const Real& c, const Vec2<Real>& reference) noexcept {
        const Real ratio = detail::hypotenuse(b, c) / detail::hypotenuse(a, c);
        squeeze = sqrt(ratio * sqrt(ratio));
        const Vec2<Real> squeezed{reference.x, squeeze * reference.y};
        mid_length = detail::hypotenuse(squeezed.x, squeezed.y);
        mid = (Real(1) / mid_length) * squeezed;
    }

    template <class Single>
    NUSSELT_HD explicit RimAngles(const RimAngles<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param squared_cosine of half of the angle between pole and reference, positive.
    NUSSELT_HD void set_stretch(const Real& squared_cosine) noexcept {
        stretch = Real(1) / sqrt(squared_cosine);
    }

    /// \param x the cosine of half of the angle of the map, times the stretch.
    /// \param s the sine of it.
    NUSSELT_HD Point at(const Real& x, const Real& s) const noexcept {
        const Real inverse = Real(1) / multiply_add(x, x, s * s);
        const Real cosine = (x - s) * (x + s) * inverse;
        const Real sine = Real(2) * x * s * inverse;
        const Vec2<Real> turned{mid.x * cosine - mid.y * sine, mid.y * cosine + mid.x * sine};
        const Vec2<Real> scaled{squeeze * turned.x, turned.y};
        const Real inverse_length = Real(1) / sqrt(dot(scaled, scaled));
        return {scaled, inverse_length, inverse_length * mid_length * sine, inverse,
                (stretch * inverse) * (squeeze * inverse_length * inverse_length)};
    }

    /// Sine and cosine of half of the angle of the map, times a length.
    /// \param point  in the disk, of any length but 0.
    /// \param across the sine of its angle from the reference, times its length.
    NUSSELT_HD SinCos<Real> half_of(const Vec2<Real>& point, const Real& across) const noexcept {
        const Vec2<Real> squeezed{point.x, squeeze * point.y};
        const Real length = detail::hypotenuse(squeezed.x, squeezed.y);
        const Real x = dot(squeezed, mid);
        const Real y = squeeze * abs(across) / mid_length;
        // The sum that does not cancel.
        const auto wide = x < Real(0);
        return {copysign(stretch * select(wide, length - x, y), across), select(wide, y, length + x)};
    }

    /// The angle of the map from half_of(), in [-pi, pi].
    NUSSELT_HD static Real angle_of(const SinCos<Real>& half) noexcept {
        return copysign(Real(2) * atan2_positive(abs(half.sin), half.cos), half.sin);
    }

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.squeeze, self.stretch, self.mid, self.mid_length);
    }
};

NUSSELT_NAMESPACE_END
