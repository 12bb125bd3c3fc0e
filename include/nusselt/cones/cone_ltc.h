#pragma once
/// Sampling of spheres, disks, ellipses and ellipsoids in proportion to a linearly transformed cosine. With a lobe that
/// fits the specular BRDF times cosine, the noise that remains comes from shadows and from the misfit.
///
/// Derived here. A linear map takes elliptic cones to elliptic cones: the columns of the light are transformed before
/// they become orthogonal. Points of the disk of the image lead back to the light itself, without the inverse of the
/// map. For spheres and disks the shape of the image is that of E. Heitz and S. Hill 2017, Linear-Light Shading with
/// Linearly Transformed Cosines.

#include <nusselt/cones/cosine_cone.h>
#include <nusselt/cones/round_lights.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/ltc/ltc.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
/// \tparam Steps  of the iteration for images above the horizon of cosine space.
/// \tparam Places of the rim where the horizon cuts it: kConePlaces, or kFineConePlaces where those do not suffice.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: that of the lobe times a factor that is
/// constant as for ConeProjectedSolidAngle. density(wi) / pdf is unbiased.
/// Space: shading space with wo in the xz half-plane (shading_frame()); clips to the horizon of cosine space by itself.
/// Edge cases: nothing of the light in the lobe, no extent, seen edge-on, an ellipsoid without volume: pdf = 0, measure
/// 0. From inside a sphere or an ellipsoid, the whole lobe leads to its surface.
/// Samples may lie below the surface, wi.z < 0: they count, with a contribution of zero.
/// Rounding may leave a sliver of a light seen edge-on, with a tiny measure.
template <class Real, template <class> class Light, int Steps = kConeSteps<Real>, int Places = kConePlaces>
class ConeLtc {
    using Scalar = scalar_t<Real>;

public:
    /// \param light in shading space [m].
    NUSSELT_HD ConeLtc(const Light<Real>& light, const Ltc<Real>& ltc) noexcept
        : ltc_(ltc),
          view_(view_of(light, [&](const Vec3<Real>& v) { return ltc.to_cosine(v); })),
          image_(view_.cone) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit ConeLtc(const ConeLtc<Single, Light, Steps, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; as continuous as that of ConeProjectedSolidAngle.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const ConeSample<Real> s = image_.sample(u);
        const auto dark = !(image_.measure() > Real(0));
        const Vec3<Real> wi =
            select(dark, Vec3<Real>{Real(0), Real(0), Real(1)}, normalize(ltc_.to_shading(s.wi)));
        const Real distance = max(dot(wi, view_.point(s.disk, wi)), Real(0));
        return {wi, pdf(wi), (view_.inverse_scale * distance) * wi};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Real factor = image_.density_per_cosine(normalize(ltc_.to_cosine(wi)));
        const Real density = Real(kPi<Scalar>) * ltc_.density(wi) * factor;
        return select(is_finite(density), density, Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        return image_.invert(normalize(ltc_.to_cosine(wi)));
    }

    /// Integral of the lobe over the light, in [0, 1].
    NUSSELT_HD Real measure() const noexcept {
        return min(Real(1 / kPi<Scalar>) * image_.measure(), Real(1));
    }

private:
    Ltc<Real> ltc_;
    LightView<Light<Real>> view_; ///< its cone is in cosine space
    CosineCone<Real, Steps, Places> image_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.ltc_, self.view_, self.image_);
    }
};

/// \name The technique for each shape.
/// @{
template <class Real>
using SphereLtc = ConeLtc<Real, Sphere>;
template <class Real>
using DiskLtc = ConeLtc<Real, Disk>;
template <class Real>
using EllipseLtc = ConeLtc<Real, Ellipse>;
template <class Real>
using EllipsoidLtc = ConeLtc<Real, Ellipsoid>;
/// @}

NUSSELT_NAMESPACE_END
