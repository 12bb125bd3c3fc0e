#pragma once
/// Sampling of a closed cylinder of finite radius in proportion to the cosine at the surface, without rejection. With a
/// Lambertian tube on a Lambertian surface, almost all noise that remains comes from shadows.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/sampling/cylinder_fan.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or many
///              samples of one light (see the broadcasting constructor).
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]. It is wi.z times a factor that varies little
/// with the azimuth around the axis: the inner integral is exact, the outer one interpolated. wi.z / pdf is unbiased.
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no part above the horizon, no length or radius, or origin inside: pdf = 0, measure 0.
template <class Real>
class CylinderProjectedSolidAngle {
public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit CylinderProjectedSolidAngle(const Cylinder<Real>& light) noexcept
        : CylinderProjectedSolidAngle(to_unit_extent(light)) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit CylinderProjectedSolidAngle(
        const CylinderProjectedSolidAngle<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves along it. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec3<Real> p = fan_.point(u);
        Vec3<Real> wi = inverse_length(p) * p;
        wi.z = max(wi.z, Real(0));
        wi = select(measure() > Real(0), wi, {Real(0), Real(0), Real(1)});
        return {wi, pdf(wi), inverse_scale_ * p};
    }

    /// The points p of samples with the same u.x, as a function of u.y: cheaper than samples where there are many. Valid as
    /// long as this.
    NUSSELT_HD auto points_at(const Real& u) const noexcept {
        return [this, points = fan_.points_at(u)](const Real& y) { return inverse_scale_ * points(y); };
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        return max(wi.z, Real(0)) * fan_.density_per_importance(wi);
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept { return fan_.invert(wi); }

    /// Estimate of the projected solid angle of the part of the light above the horizon [sr]: good enough for weights
    /// of multiple importance sampling, not for shading. cylinder_fan.h has its errors.
    NUSSELT_HD Real measure() const noexcept { return fan_.integral(); }

private:
    NUSSELT_HD explicit CylinderProjectedSolidAngle(const ScaledLight<Cylinder<Real>, Real>& unit) noexcept
        : fan_(unit.light, {}), inverse_scale_(unit.inverse_scale) {}

    CylinderFan<Real, ShadingSpace<Real>, CosineImportance> fan_; ///< scaled to an extent of order one
    Real inverse_scale_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.fan_, self.inverse_scale_);
    }
};

NUSSELT_NAMESPACE_END
