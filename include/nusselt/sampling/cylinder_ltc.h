#pragma once
/// Sampling of a closed cylinder of finite radius in proportion to a linearly transformed cosine, without rejection.
/// With a lobe that fits the specular BRDF times cosine, the noise that remains comes from shadows and from the misfit.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/ltc/ltc.h>
#include <nusselt/sampling/cylinder_fan.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or many
///              samples of one light (see the broadcasting constructor).
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: that of the lobe times a factor that varies
/// little with the azimuth around the image of the axis. density(wi) / pdf is unbiased.
/// Space: shading space with wo in the xz half-plane (shading_frame()); clips to the horizon of cosine space by itself.
/// Edge cases: nothing of the light in the lobe, no length or radius, or origin inside: pdf = 0, measure 0.
/// Samples may lie below the surface, wi.z < 0: they count, with a contribution of zero.
template <class Real>
class CylinderLtc {
public:
    /// \param light in shading space [m].
    NUSSELT_HD CylinderLtc(const Cylinder<Real>& light, const Ltc<Real>& ltc) noexcept
        : CylinderLtc(to_unit_extent(light), ltc) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit CylinderLtc(const CylinderLtc<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves along it. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> p = fan_.point(u);
        const Vec3<Real> direction = inverse_length(p) * p;
        const Vec3<Real> wi = select(measure() > Real(0), direction, {Real(0), Real(0), Real(1)});
        return {wi, pdf(wi), inverse_scale_ * p};
    }

    /// The points p of samples with the same u.x, as a function of u.y: cheaper than samples where there are many. Valid as
    /// long as this.
    NUSSELT_HD auto points_at(const Real& u) const noexcept {
        return [this, points = fan_.points_at(u)](const Real& y) { return inverse_scale_ * points(y); };
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Real pi = Real(kPi<scalar_t<Real>>);
        const Real density = pi * ltc_.density(wi) * fan_.density_per_importance(wi);
        return select(is_finite(density), density, Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept { return fan_.invert(wi); }

    /// Estimate of the integral of the lobe over the light: good enough for weights of multiple importance sampling,
    /// not for shading. cylinder_fan.h has its errors.
    NUSSELT_HD Real measure() const noexcept { return Real(1 / kPi<scalar_t<Real>>) * fan_.integral(); }

private:
    NUSSELT_HD CylinderLtc(const ScaledLight<Cylinder<Real>, Real>& unit, const Ltc<Real>& ltc) noexcept
        : ltc_(ltc), fan_(unit.light, ltc), inverse_scale_(unit.inverse_scale) {}

    Ltc<Real> ltc_;
    CylinderFan<Real, Ltc<Real>, CosineImportance> fan_; ///< scaled to an extent of order one
    Real inverse_scale_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.ltc_, self.fan_, self.inverse_scale_);
    }
};

NUSSELT_NAMESPACE_END
