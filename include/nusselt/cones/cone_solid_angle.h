#pragma once
/// Sampling of the solid angle of spheres, disks, ellipses and ellipsoids, for surfaces and for volumes.
///
/// Derived here. The map is that of spherical_ellipse.h. The density of the angle around the axis is between 1/2 and 1
/// for every cone, and interpolated in one quadrant. For spheres it is constant: the method is that of C. Wang 1992,
/// Physically correct direct lighting for distribution ray tracing, Graphics Gems III.

#include <nusselt/cones/spherical_ellipse.h>
#include <nusselt/sampling/piecewise_linear.h>

NUSSELT_NAMESPACE_BEGIN

/// The turn around the axis of an elliptic cone: the drop is interpolated linearly between eight nodes of a quadrant.
template <class Real>
class InterpolatedTurn {
    using Scalar = scalar_t<Real>;
    static constexpr int kNodes = 8;
    using Warp = PiecewiseLinear<Real, kNodes>;

public:
    static constexpr bool kIsExact = false;

    InterpolatedTurn() = default;
    NUSSELT_HD explicit InterpolatedTurn(const RimDrop<Real>& drop) noexcept : drop_(drop) {
        Real value[kNodes];
        for (int i = 0; i < kNodes; ++i) {
            const auto turn = sincos_quarter_turn(Real(kPi<Scalar> / 2 * Warp::node(i)));
            value[i] = drop_(turn.cos, turn.sin);
        }
        warp_ = Warp(value);
    }
    template <class Single>
    NUSSELT_HD explicit InterpolatedTurn(const InterpolatedTurn<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_HD Real drop(const Real& cosine, const Real& sine) const noexcept { return drop_(cosine, sine); }
    NUSSELT_HD const Real& integral() const noexcept { return warp_.integral(); }
    NUSSELT_HD Real invert(const Real& share) const noexcept { return warp_.invert(share); }
    NUSSELT_HD Real below(const Real& part) const noexcept { return warp_.below(part); }
    NUSSELT_HD Real weight(const Real& part, const Real& cosine, const Real& sine) const noexcept {
        return warp_.value(part) / drop_(cosine, sine);
    }

private:
    RimDrop<Real> drop_;
    Warp warp_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.drop_, self.warp_);
    }
};

/// The turn around the axis of a circular cone: the drop is constant.
template <class Real>
class EvenTurn {
public:
    static constexpr bool kIsExact = true;

    EvenTurn() = default;
    NUSSELT_HD explicit EvenTurn(const RimDrop<Real>& drop) noexcept : drop_(drop(Real(1), Real(0))) {}
    template <class Single>
    NUSSELT_HD explicit EvenTurn(const EvenTurn<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_HD const Real& drop(const Real&, const Real&) const noexcept { return drop_; }
    NUSSELT_HD const Real& integral() const noexcept { return drop_; }
    NUSSELT_HD static Real invert(const Real& share) noexcept { return share; }
    NUSSELT_HD Real below(const Real& part) const noexcept { return part * drop_; }

private:
    Real drop_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.drop_);
    }
};

namespace detail {

template <template <class> class Light>
struct TurnOf {
    template <class Real>
    using Type = InterpolatedTurn<Real>;
};
template <>
struct TurnOf<Sphere> {
    template <class Real>
    using Type = EvenTurn<Real>;
};

} // namespace detail

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]. It is constant for spheres. 1 / pdf is
/// unbiased, and for other lights within 1 % of the mean. measure() is exact for spheres, and else has a relative error
/// below 1 %.
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no extent, seen edge-on, an ellipsoid without volume: pdf = 0, measure 0. From inside a sphere or an
/// ellipsoid, all directions lead to its surface.
/// Rounding may leave a sliver of a light seen edge-on, with a tiny measure.
template <class Real, template <class> class Light>
using ConeSolidAngle = SphericalEllipse<Real, Light, detail::TurnOf<Light>::template Type>;

/// \name The technique for each shape.
/// @{
template <class Real>
using SphereSolidAngle = ConeSolidAngle<Real, Sphere>;
template <class Real>
using DiskSolidAngle = ConeSolidAngle<Real, Disk>;
template <class Real>
using EllipseSolidAngle = ConeSolidAngle<Real, Ellipse>;
template <class Real>
using EllipsoidSolidAngle = ConeSolidAngle<Real, Ellipsoid>;
/// @}

NUSSELT_NAMESPACE_END
