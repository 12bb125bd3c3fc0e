#pragma once
/// Sampling of the part above the surface of spheres, disks, ellipses and ellipsoids in proportion to a linearly
/// transformed cosine.
///
/// Derived here. In cosine space the surface's horizon is one more plane through the origin. Where it cuts the light,
/// half-planes around the line in which both horizons meet sweep the light (lune_sweep.h). Lobes are symmetric to the
/// plane of incidence, so that this line is always the y-axis. Elsewhere samples are those of ConeLtc.

#include <nusselt/cones/cone_ltc.h>
#include <nusselt/cones/lune_sweep.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
/// \tparam Steps  of the iteration for images above both horizons.
/// \tparam Places of the rim where a horizon cuts it: kConePlaces, or kFineConePlaces where those do not suffice.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: that of the lobe times a factor that is nearly
/// constant (docs/techniques/elliptic_cone.md has numbers). density(wi) / pdf is unbiased.
/// Space: shading space with wo in the xz half-plane (shading_frame()); clips to both horizons. wi.z is not negative.
/// Edge cases: those of ConeLtc; nothing above both horizons: pdf = 0, measure 0. A light that touches a horizon up to
/// rounding counts as not cut by it. From inside a sphere or an ellipsoid, the part of the lobe above the surface leads
/// to its surface.
template <class Real, template <class> class Light, int Steps = kConeSteps<Real>, int Places = kConePlaces>
class ConeClippedLtc {
    using Scalar = scalar_t<Real>;

public:
    /// \param light in shading space [m].
    NUSSELT_HD ConeClippedLtc(const Light<Real>& light, const Ltc<Real>& ltc) noexcept
        : ltc_(ltc),
          view_(view_of(light, [&](const Vec3<Real>& v) { return ltc.to_cosine(v); })),
          image_(),
          lune_() {
        const LuneMap<Real> map(view_.cone,
                                normalize(ltc.normal_to_cosine(Vec3<Real>{Real(0), Real(0), Real(1)})));
        is_clipped_ = map.is_clipped();
        if (!all(is_clipped_)) image_ = CosineCone<Real, Steps, Places>(view_.cone);
        // The sweep is costly to prepare, and seldom needed.
        if (any(is_clipped_)) lune_ = LuneSweep<Real, Places>(map, view_.cone.is_visible);
        measure_ = select(is_clipped_, lune_.measure(), select(map.is_lit(), image_.measure(), Real(0)));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit ConeClippedLtc(const ConeClippedLtc<Single, Light, Steps, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around an axis, u.y leads away from it or along it. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const ConeSample<Real> s = image_sample(u);
        const auto dark = !(measure_ > Real(0));
        Vec3<Real> direction = ltc_.to_shading(s.wi);
        // Rounding must not lead below a horizon that the light touches.
        direction.z = max(direction.z, Real(0));
        const Vec3<Real> wi = select(dark, Vec3<Real>{Real(0), Real(0), Real(1)}, normalize(direction));
        const Real distance = max(dot(wi, view_.point(s.disk, wi)), Real(0));
        return {wi, pdf(wi), (view_.inverse_scale * distance) * wi};
    }

    /// \param wi a unit direction towards the light.
    /// \return 0 below the surface.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> image = normalize(ltc_.to_cosine(wi));
        Real factor = Real(0);
        if (!all(is_clipped_)) factor = image_.density_per_cosine(image);
        if (any(is_clipped_)) factor = select(is_clipped_, lune_.density_per_cosine(image), factor);
        const Real density = Real(kPi<Scalar>) * ltc_.density(wi) * factor;
        const auto lit = (measure_ > Real(0)) & (wi.z >= Real(0)) & is_finite(density);
        return select(lit, density, Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light and above the surface.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> image = normalize(ltc_.to_cosine(wi));
        if (all(is_clipped_)) return lune_.invert(image);
        const Vec2<Real> u = image_.invert(image);
        if (!any(is_clipped_)) return u;
        return select(is_clipped_, lune_.invert(image), u);
    }

    /// Integral of the lobe over the part of the light above the surface, in [0, 1].
    NUSSELT_HD Real measure() const noexcept { return min(Real(1 / kPi<Scalar>) * measure_, Real(1)); }

private:
    NUSSELT_HD ConeSample<Real> image_sample(const Vec2<Real>& u) const noexcept {
        if (all(is_clipped_)) return lune_.sample(u);
        const ConeSample<Real> whole = image_.sample(u);
        if (!any(is_clipped_)) return whole;
        const ConeSample<Real> cut = lune_.sample(u);
        return {select(is_clipped_, cut.wi, whole.wi), select(is_clipped_, cut.disk, whole.disk)};
    }

    Ltc<Real> ltc_;
    LightView<Light<Real>> view_;           ///< its cone is in cosine space
    mask_t<Real> is_clipped_;               ///< whether the surface's horizon cuts the light
    CosineCone<Real, Steps, Places> image_; ///< only where it does not, in any lane
    LuneSweep<Real, Places> lune_;          ///< only where it does, in any lane
    Real measure_; ///< projected solid angle of the part of the image that counts [sr]

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.ltc_, self.view_, self.is_clipped_, self.image_, self.lune_, self.measure_);
    }
};

/// \name The technique for each shape.
/// @{
template <class Real>
using SphereClippedLtc = ConeClippedLtc<Real, Sphere>;
template <class Real>
using DiskClippedLtc = ConeClippedLtc<Real, Disk>;
template <class Real>
using EllipseClippedLtc = ConeClippedLtc<Real, Ellipse>;
template <class Real>
using EllipsoidClippedLtc = ConeClippedLtc<Real, Ellipsoid>;
/// @}

NUSSELT_NAMESPACE_END
