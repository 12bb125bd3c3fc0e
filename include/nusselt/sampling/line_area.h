#pragma once
/// Uniform sampling of the length of a linear light. It needs no trigonometry, but is noisy close to the
/// light.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/line_segment.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double, one light and shading point per
///              lane.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr]:
/// |p|^2 / (2 length |wi x s|). The emission of the light is radiance times radius, so that the radius
/// cancels (Peters 2021, linear lights, Sec. 3.1). Space: any frame with the shading point as origin; no
/// clipping, so that wi may point below the horizon. Edge cases: no length, or origin on the infinite line:
/// pdf = 0.
template <class Real>
class LineArea {
public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit LineArea(const LineSegment<Real>& light) noexcept
        : light_(light), distance_(length(cross(light.p0, light.s))) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit LineArea(const LineArea<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1), proportional to the distance from the start.
    NUSSELT_HD LightSample<Real> sample(const Real& u) const noexcept {
        const Vec3<Real> p = light_.p0 + (u * light_.length) * light_.s;
        const Real r = length(p);
        // |wi x s| = distance / r; from wi it would lose its precision where the light is seen end-on.
        return {normalize(p), density(r, distance_ / select(r > Real(0), r, Real(1))), p};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Real sine = length(cross(wi, light_.s));
        return density(distance_ / select(sine > Real(0), sine, Real(1)), sine);
    }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept {
        const Real start = dot(light_.p0, light_.s);
        const Real along = dot(wi, light_.s);
        const Real sine = length(cross(wi, light_.s));
        const Real coordinate = distance_ * along / select(sine > Real(0), sine, Real(1)) - start;
        return below_one(coordinate / select(light_.length > Real(0), light_.length, Real(1)));
    }

    /// Length of the light [m].
    NUSSELT_HD Real measure() const noexcept { return light_.length; }

private:
    NUSSELT_HD Real density(const Real& r, const Real& sine) const noexcept {
        return detail::area_density(r, Real(2) * light_.length * sine);
    }

    LineSegment<Real> light_;
    Real distance_; ///< of the infinite line from the origin [m]

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.light_, self.distance_);
    }
};

NUSSELT_NAMESPACE_END
