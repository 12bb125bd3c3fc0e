#pragma once
/// Sampling of a linear light proportional to a linearly transformed cosine. With a lobe that fits the specular BRDF
/// times cosine, the noise that remains comes from shadows and from the misfit.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379, Sec. 4.1 with Eq. 5:
/// projected solid angle sampling of the image of the segment in cosine space. Deviation: points, not directions, come
/// back to shading space, by their position along the light.

#include <nusselt/core/broadcast.h>
#include <nusselt/ltc/light_transform.h>
#include <nusselt/sampling/line_projected_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real     float, double, long double or a pack of float or double: one light and shading point per lane, or
///                  many samples of one light (see the broadcasting constructor).
/// \tparam Horizons CosineHorizon, or BothHorizons for samples that are never below the surface.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr],
/// density(wi) / measure() of the lobe. The emission of the light is radiance times radius, so that the radius cancels.
/// Space: shading space with wo in the xz half-plane (shading_frame()); clips by itself.
/// Edge cases: nothing of the light in the lobe, no length, or origin on the infinite line up to rounding, in shading space
/// or in cosine space: pdf = 0, measure 0.
/// With CosineHorizon samples may lie below the surface, wi.z < 0: they count, with a contribution of zero.
template <class Real, class Horizons = CosineHorizon>
class LineLtc {
public:
    /// \param light in shading space [m].
    NUSSELT_HD LineLtc(const LineSegment<Real>& light, const Ltc<Real>& ltc) noexcept
        : LineLtc(part_of(to_safe_extent(light)), ltc) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit LineLtc(const LineLtc<Single, Horizons>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1); increasing u moves from the start of the light to its end.
    NUSSELT_HD LightSample<Real> sample(const Real& u) const noexcept {
        // Only the coordinate along the light comes from cosine space: rounding there must not leave the light.
        const Real along = dot(ltc_.to_shading(image_.sample(u).p), s_) / ltc_.minor();
        const Vec3<Real> p = Horizons::lifted(fma(min(max(along, l0_), l1_), s_, closest_));
        const Vec3<Real> wi = inverse_length(p) * p;
        return {wi, pdf(wi), inverse_scale_ * p};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Real density = ltc_.density(wi) * inverse_measure_;
        return select(is_finite(density), density, Real(0));
    }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept {
        return image_.invert(normalize(ltc_.to_cosine(wi)));
    }

    /// Integral of the lobe over the light per radius [1/m].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    NUSSELT_INLINE static SafeLine<Real> part_of(const SafeLine<Real>& safe) noexcept {
        return {Horizons::part_of(safe.line), safe.squared_reach, safe.scale, safe.inverse_scale};
    }

    /// \param safe the part of the light that counts.
    NUSSELT_INLINE LineLtc(const SafeLine<Real>& safe, const Ltc<Real>& ltc) noexcept
        : ltc_(ltc), image_(to_cosine_space(safe.line, ltc)), inverse_scale_(safe.inverse_scale) {
        // Describe the line by its closest point and the coordinates of its ends.
        const CenteredLine<Real> line = centered(safe);
        s_ = line.inward;
        closest_ = line.closest;
        l0_ = line.near_l;
        l1_ = line.far_l;

        // Correct the radius, which differs in cosine space (Eq. 5). The ratio is the reciprocal of what the density of
        // directions on the image is divided by.
        const Real ratio = Real(kPi<scalar_t<Real>>) * radius_ratio(cross(safe.line.p0, safe.line.s), ltc);
        const auto in_lobe = image_.measure() > Real(0);
        const auto seen = (line.length > Real(0)) & in_lobe & (ratio > Real(0));
        const Real measure = image_.measure() / select(seen, ratio, Real(1)) * safe.scale;
        const Real inverse = ratio / select(seen, image_.measure(), Real(1)) * inverse_scale_;
        const auto fits = is_finite(max(measure, inverse));
        const auto lit = seen & fits & (measure > Real(0));
        measure_ = select(lit, measure, Real(0));
        inverse_measure_ = select(lit, inverse, Real(0));
    }

    Ltc<Real> ltc_;
    LineProjectedSolidAngle<Real> image_; ///< in cosine space

    // The part of the light that counts, in shading space and scaled to an extent of order one.
    Vec3<Real> s_;       ///< from the near end to the far one
    Vec3<Real> closest_; ///< point of the infinite line
    Real l0_, l1_;       ///< coordinates of the near and the far end along s, 0 at the closest point
    Real inverse_scale_; ///< a power of two

    Real measure_;
    Real inverse_measure_; ///< 0 without light

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.ltc_, self.image_, self.s_, self.closest_, self.l0_, self.l1_, self.inverse_scale_,
              self.measure_, self.inverse_measure_);
    }
};

/// Samples are never below the surface: wi.z is not negative.
template <class Real>
using LineClippedLtc = LineLtc<Real, BothHorizons>;

NUSSELT_NAMESPACE_END
