#pragma once
/// Uniform sampling of the solid angle of a linear light, for surfaces and for volumes.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.1,
/// Eq. 1. Deviations: everything is expressed by the end points, so that nothing cancels for short or distant
/// lights; neither preparation nor sampling needs trigonometry.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/clip_line.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double, one light and shading point per
///              lane.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr],
/// the constant 1 / measure(). The emission of the light is radiance times radius, so that the radius
/// cancels. Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no length, or origin on the infinite line up to rounding: pdf = 0, measure 0.
template <class Real>
class LineSolidAngle {
public:
    /// \param light relative to the shading point [m].
    NUSSELT_INLINE explicit LineSolidAngle(const LineSegment<Real>& light) noexcept
        : LineSolidAngle(to_safe_extent(light), WholeExtent()) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit LineSolidAngle(const LineSolidAngle<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1); increasing u moves from the start of the light to its end.
    NUSSELT_INLINE LightSample<Real> sample(const Real& u) const noexcept {
        const LinePoint<Real> point = map_.point_at(multiply_add(u, sign_, offset_));
        const Vec3<Real> p = map_.position(point);
        return {map_.direction(point, p), pdf_, inverse_scale_ * p};
    }

    /// Constant on the light; the caller knows that wi hits it.
    NUSSELT_HD Real pdf(const Vec3<Real>&) const noexcept { return pdf_; }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept {
        return below_one((map_.share_in(wi) - offset_) * sign_);
    }

    /// Solid angle per radius, in the limit of a thin cylinder [sr/m].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

protected:
    struct WholeExtent {
        NUSSELT_INLINE LineExtent<Real> operator()(const SafeLine<Real>& safe) const noexcept {
            return whole_extent(safe);
        }
    };
    struct ClippedExtent {
        NUSSELT_INLINE LineExtent<Real> operator()(const SafeLine<Real>& safe) const noexcept {
            return clipped_extent(safe);
        }
    };

    /// \param extent_of returns the extent of the part of a segment to sample.
    template <class ExtentOf>
    NUSSELT_INLINE LineSolidAngle(const SafeLine<Real>& safe, ExtentOf extent_of) noexcept
        : LineSolidAngle(safe, extent_of(safe)) {}

private:
    NUSSELT_INLINE LineSolidAngle(const SafeLine<Real>& safe, const LineExtent<Real>& extent) noexcept
        : map_(extent), inverse_scale_(safe.inverse_scale) {
        sign_ = extent.line.sign;
        offset_ = multiply_add(Real(-0.5), sign_, Real(0.5));
        // Eq. 1 in the limit of a radius of 0.
        const auto ratio = extent.sine_ratio();
        const Real measure = Real(2) * extent.distance * extent.sine_extent().density * safe.scale;
        const Real density =
            Real(0.5) * ratio.denominator / (extent.distance * ratio.numerator) * inverse_scale_;
        // The density of a line of denormal length may overflow although the measure is in range.
        const auto has_density = is_finite(density);
        const auto lit = has_reciprocal(measure) & has_density;
        measure_ = select(lit, measure, Real(0));
        pdf_ = select(lit, density, Real(0));
    }

    LineMap<Real> map_;
    Real sign_,
        offset_; ///< of the map from random numbers, which count from the start, to shares from the near end
    Real inverse_scale_;
    Real measure_;
    Real pdf_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.map_, self.sign_, self.offset_, self.inverse_scale_, self.measure_, self.pdf_);
    }
};

/// Uniform sampling of the solid angle of the part of a linear light above the horizon, in shading space: wi.z is never
/// negative.
/// \copydetails LineSolidAngle
template <class Real>
class LineClippedSolidAngle : public LineSolidAngle<Real> {
public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit LineClippedSolidAngle(const LineSegment<Real>& light) noexcept
        : LineSolidAngle<Real>(to_safe_extent(light), typename LineSolidAngle<Real>::ClippedExtent()) {}

    /// \copydoc LineSolidAngle::LineSolidAngle(const LineSolidAngle<Single>&)
    template <class Single>
    NUSSELT_HD explicit LineClippedSolidAngle(const LineClippedSolidAngle<Single>& single) noexcept
        : LineSolidAngle<Real>(static_cast<const LineSolidAngle<Single>&>(single)) {}

    /// \copydoc LineSolidAngle::sample
    NUSSELT_INLINE LightSample<Real> sample(const Real& u) const noexcept {
        LightSample<Real> s = LineSolidAngle<Real>::sample(u);
        // Next to the horizon, rounding turns directions below it.
        s.wi.z = max(s.wi.z, Real(0));
        return s;
    }
};

NUSSELT_NAMESPACE_END
