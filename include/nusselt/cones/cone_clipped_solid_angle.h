#pragma once
/// Sampling of the solid angle of the part of spheres, disks, ellipses and ellipsoids above the surface.
///
/// Derived here. A light above the horizon has the samples of ConeSolidAngle. A horizon that cuts it needs another
/// pole, on the horizon: see solid_sweep.h. Both maps are continuous.

#include <nusselt/cones/cone_solid_angle.h>
#include <nusselt/cones/cosine_cone.h>
#include <nusselt/cones/solid_sweep.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
/// \tparam Places of the rim where the horizon cuts it, kConePlaces or kFineConePlaces.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], that of the samples in any case. 1 / pdf is
/// unbiased for the part above the horizon, and constant but for an interpolant (docs/techniques/elliptic_cone.md has
/// numbers).
/// Space: shading space; the shading point is the origin, the normal +z. wi.z is not negative.
/// Edge cases: no part above the horizon, no extent, seen edge-on, an ellipsoid without volume: pdf = 0, measure 0.
/// From inside a sphere or an ellipsoid, all directions above the horizon lead to its surface.
/// Rounding may leave a sliver of a light seen edge-on, with a tiny measure.
template <class Real, template <class> class Light, int Places = kConePlaces>
class ConeClippedSolidAngle {
public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit ConeClippedSolidAngle(const Light<Real>& light) noexcept : whole_(light), sweep_() {
        const EllipticCone<Real>& cone = whole_.view().cone;
        // A half-space below the horizon touches it as well.
        is_whole_ = is_above_horizon(cone) & (cone.e3.z > Real(0));
        // The sweep is costly to prepare, and seldom needed.
        if (any(!is_whole_)) sweep_ = SolidSweep<Real, Places>(cone);
        // From inside, the samples of the whole light fill the sphere from the zenith to the nadir.
        share_ = select(whole_.view().is_open(), Real(0.5), Real(1));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit ConeClippedSolidAngle(
        const ConeClippedSolidAngle<Single, Light, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, or around a pole on the horizon that cuts the light, u.y leads
    /// away.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        LightSample<Real> s = whole_.sample({u.x, share_ * u.y});
        // Rounding must not lead below a horizon that the light touches.
        s.wi.z = max(s.wi.z, Real(0));
        s.p.z = max(s.p.z, Real(0));
        if (!all(is_whole_)) {
            const ConeSample<Real> cut = sweep_.sample(u);
            const auto& view = whole_.view();
            const auto dark = !(sweep_.measure() > Real(0));
            const Vec3<Real> wi = select(dark, Vec3<Real>{Real(0), Real(0), Real(1)}, cut.wi);
            const Real distance = max(dot(wi, view.point(cut.disk, wi)), Real(0));
            s.wi = select(is_whole_, s.wi, wi);
            s.p = select(is_whole_, s.p, (view.inverse_scale * distance) * wi);
        }
        s.pdf = pdf(s.wi);
        return s;
    }

    /// \param wi a unit direction towards the light.
    /// \return 0 below the horizon.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        Real density = whole_.pdf(wi) / share_;
        if (!all(is_whole_)) density = select(is_whole_, density, sweep_.density(wi));
        return select(is_finite(density) & (wi.z >= Real(0)), density, Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light and above the horizon.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        Vec2<Real> u = whole_.invert(wi);
        u.y = below_one(u.y / share_);
        if (all(is_whole_)) return u;
        return select(is_whole_, u, sweep_.invert(wi));
    }

    /// Estimate of the solid angle above the horizon [sr], at most 2 pi. Where the horizon cuts lights it is a
    /// quadrature with as many nodes as places; pdf does not depend on its error.
    NUSSELT_HD Real measure() const noexcept {
        const Real whole = share_ * whole_.measure();
        if (all(is_whole_)) return whole;
        return select(is_whole_, whole, min(sweep_.measure(), Real(2 * kPi<scalar_t<Real>>)));
    }

private:
    ConeSolidAngle<Real, Light> whole_;
    mask_t<Real> is_whole_;
    SolidSweep<Real, Places> sweep_; ///< only where the horizon cuts a light in any lane
    Real share_;                     ///< of the samples of the whole light that are above the horizon

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.whole_, self.is_whole_, self.sweep_, self.share_);
    }
};

/// \name The technique for each shape.
/// @{
template <class Real>
using SphereClippedSolidAngle = ConeClippedSolidAngle<Real, Sphere>;
template <class Real>
using DiskClippedSolidAngle = ConeClippedSolidAngle<Real, Disk>;
template <class Real>
using EllipseClippedSolidAngle = ConeClippedSolidAngle<Real, Ellipse>;
template <class Real>
using EllipsoidClippedSolidAngle = ConeClippedSolidAngle<Real, Ellipsoid>;
/// @}

NUSSELT_NAMESPACE_END
