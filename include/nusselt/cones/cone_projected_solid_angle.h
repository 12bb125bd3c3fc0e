#pragma once
/// Sampling of spheres, disks, ellipses and ellipsoids in proportion to the cosine at the surface. With a Lambertian
/// emitter on a Lambertian surface, all noise that remains comes from shadows.
///
/// Derived here, see whole_cone.h and cone_sweep.h: all these lights are elliptic cones. Cones that the horizon cuts
/// and those above it have different maps, both of which are continuous.

#include <nusselt/cones/cosine_cone.h>
#include <nusselt/cones/round_lights.h>
#include <nusselt/core/light_sample.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
/// \tparam Steps  of the iteration for cones above the horizon.
/// \tparam Places of the rim where the horizon cuts it: kConePlaces, or kFineConePlaces where those do not suffice.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]. Above the horizon it is wi.z / measure().
/// Where the horizon cuts the light it is that, or, where an interpolant of the measure of a sweep is not exact up to
/// rounding, that times the ratio of interpolant and sweep: wi.z / pdf is unbiased in any case.
/// Accuracy: where the horizon cuts the light, measure() is a quadrature with as many nodes as places. With
/// kConePlaces, of lights near the point or much longer than wide, 99 % are off by at most 6e-3 and a few by much more;
/// with kFineConePlaces, of lights that touch the point or are 100 times longer than wide, 99 % are off by at most 1e-5
/// (docs/techniques/elliptic_cone.md). pdf is the density of the samples in any case.
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no part above the horizon, no extent, seen edge-on, an ellipsoid without volume: pdf = 0, measure 0.
/// From inside a sphere or an ellipsoid, all directions above the horizon lead to its surface.
/// Rounding may leave a sliver of a light seen edge-on, with a tiny measure.
template <class Real, template <class> class Light, int Steps = kConeSteps<Real>, int Places = kConePlaces>
class ConeProjectedSolidAngle {
public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit ConeProjectedSolidAngle(const Light<Real>& light) noexcept
        : view_(view_of(light, detail::SameSpace())), cone_(view_.cone) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit ConeProjectedSolidAngle(
        const ConeProjectedSolidAngle<Single, Light, Steps, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2. Continuous in both for cones above the horizon and for those that it cuts.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const ConeSample<Real> s = cone_.sample(u);
        const auto dark = !(measure() > Real(0));
        const Vec3<Real> wi = select(dark, Vec3<Real>{Real(0), Real(0), Real(1)}, s.wi);
        // The point is that of the disk, moved to the ray: close to a large light, directions are more accurate than
        // points.
        const Real distance = max(dot(wi, view_.point(s.disk, wi)), Real(0));
        return {wi, pdf(wi), (view_.inverse_scale * distance) * wi};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Real density = max(wi.z, Real(0)) * cone_.density_per_cosine(wi);
        return select(is_finite(density), density, Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept { return cone_.invert(wi); }

    /// Projected solid angle of the part of the light above the horizon, at most pi [sr].
    NUSSELT_HD Real measure() const noexcept { return min(cone_.measure(), Real(kPi<scalar_t<Real>>)); }

private:
    LightView<Light<Real>> view_;
    CosineCone<Real, Steps, Places> cone_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.view_, self.cone_);
    }
};

/// \name The technique for each shape.
/// @{
template <class Real>
using SphereProjectedSolidAngle = ConeProjectedSolidAngle<Real, Sphere>;
template <class Real>
using DiskProjectedSolidAngle = ConeProjectedSolidAngle<Real, Disk>;
template <class Real>
using EllipseProjectedSolidAngle = ConeProjectedSolidAngle<Real, Ellipse>;
template <class Real>
using EllipsoidProjectedSolidAngle = ConeProjectedSolidAngle<Real, Ellipsoid>;
/// @}

NUSSELT_NAMESPACE_END
