#pragma once
/// Uniform sampling of the projected solid angle of a linear light: density proportional to the cosine at the
/// surface. With a Lambertian tube on a Lambertian surface, all noise that remains comes from shadows.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.2 and
/// 3.3, Algorithms 1 and 2. cosine_arc.h lists the deviations.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/sampling/cosine_arc.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real       float, double, long double or a pack of float or double: one light and shading point
///                    per lane, or many samples of one light (see the broadcasting constructor).
/// \tparam Iterations steps of the iteration per sample, at most.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr],
/// wi.z / measure(). The emission of the light is radiance times radius, so that the radius cancels.
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no part above the horizon, no length, or origin on the infinite line up to rounding: pdf = 0, measure 0.
template <class Real, int Iterations = kLineIterations<Real>>
class LineProjectedSolidAngle {
public:
    /// Uninitialised: to be assigned to before it is used.
    LineProjectedSolidAngle() = default;

    /// \param light in shading space [m].
    NUSSELT_INLINE explicit LineProjectedSolidAngle(const LineSegment<Real>& light) noexcept
        : LineProjectedSolidAngle(to_safe_extent(light)) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit LineProjectedSolidAngle(
        const LineProjectedSolidAngle<Single, Iterations>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1); increasing u moves from the start of the light to its end.
    NUSSELT_INLINE LightSample<Real> sample(const Real& u) const noexcept {
        const LinePoint<Real> point = arc_.point(u);
        const Vec3<Real> p = arc_.map().position(point);
        Vec3<Real> wi = arc_.map().direction(point, p);
        wi.z = max(wi.z, Real(0));
        return {wi, pdf(wi), inverse_scale_ * p};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return max(wi.z, Real(0)) * inverse_measure_; }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept { return arc_.invert(wi); }

    /// Projected solid angle per radius of the part of the light above the horizon [sr/m].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    NUSSELT_INLINE explicit LineProjectedSolidAngle(const SafeLine<Real>& safe) noexcept
        : LineProjectedSolidAngle(safe, clipped_extent(safe)) {}

    NUSSELT_INLINE LineProjectedSolidAngle(const SafeLine<Real>& safe,
                                           const LineExtent<Real>& extent) noexcept
        : arc_(extent), inverse_scale_(safe.inverse_scale) {
        const Real measure = arc_.integral() * extent.inverse_distance() * safe.scale;
        const Real inverse = arc_.inverse_integral() * extent.distance * inverse_scale_;
        // The reciprocal of a denormal integral may overflow although the measure is in range.
        const auto has_density = has_reciprocal(arc_.integral());
        const auto lit = has_reciprocal(measure) & has_density;
        measure_ = select(lit, measure, Real(0));
        inverse_measure_ = select(lit, inverse, Real(0));
    }

    CosineArc<Real, Iterations> arc_; ///< of the part above the horizon, scaled to an extent of order one
    Real inverse_scale_;
    Real measure_;
    Real inverse_measure_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.arc_, self.inverse_scale_, self.measure_, self.inverse_measure_);
    }
};

NUSSELT_NAMESPACE_END
