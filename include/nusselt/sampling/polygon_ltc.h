#pragma once
/// Sampling of a convex polygon proportional to a linearly transformed cosine. With a Lambertian emitter and a lobe
/// that fits the specular BRDF times cosine, the noise that remains comes from shadows and from the misfit.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672, Sec. 4.1:
/// projected solid angle sampling of the image of the polygon in cosine space. Deviation: the hit point lies where the
/// direction meets the plane of the light in shading space. Where that plane almost contains the shading point, the point on
/// the image comes back to shading space instead. Where a direction would miss that point by more than rounding explains,
/// next to the horizon of the lobe or because hardly any of the lobe reaches the light, it leads to the point.

#include <nusselt/core/broadcast.h>
#include <nusselt/geometry/polygon_hull.h>
#include <nusselt/ltc/light_transform.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real     float, double, long double or a pack of float or double: one light and shading point per lane, or
///                  many samples of one light (see the broadcasting constructor).
/// \tparam N        bound on the number of vertices before clipping, 3 to 8, or to 7 with BothHorizons.
/// \tparam Horizons CosineHorizon, or BothHorizons for samples that are never below the surface.
/// \tparam Image    technique for the image of the polygon in cosine space, with at most Horizons::kVertices<N> vertices.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], density(wi) / measure() of the lobe.
/// Space: shading space with wo in the xz half-plane (shading_frame()); clips by itself.
/// Edge cases: nothing of the light in the lobe, no area, or origin in the plane of the polygon: pdf = 0, measure 0.
/// With CosineHorizon samples may lie below the surface, wi.z < 0: they count, with a contribution of zero.
/// Accuracy: p is in the plane of the light, but for rare points that the box around the light moves. The closer that plane
/// and the narrower the lobe, the farther p may leave the ray along wi, in rare cases by much of the light: aim at p.
template <class Real, int N, class Horizons = CosineHorizon,
          class Image = PolygonProjectedSolidAngle<Real, Horizons::template kVertices<N>>>
class PolygonLtc {
    static constexpr int kVertices = Horizons::template kVertices<N>;

public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD PolygonLtc(const ConvexPolygon<Real, N>& light, const Ltc<Real>& ltc) noexcept
        : PolygonLtc(Horizons::part_of(light), ltc) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single, class SingleImage>
    NUSSELT_HD explicit PolygonLtc(const PolygonLtc<Single, N, Horizons, SingleImage>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; as continuous as that of PolygonProjectedSolidAngle.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        using Scalar = scalar_t<Real>;
        constexpr Scalar kEpsilon = std::numeric_limits<Scalar>::epsilon();
        const LightSample<Real> sampled = image_.sample(u);
        const Vec3<Real> direction = normalize(Horizons::lifted(ltc_.to_shading(sampled.wi)));
        const Vec3<Real> up{Real(0), Real(0), Real(1)};
        const auto dark = inverse_measure_ == Real(0);
        Vec3<Real> wi = select(dark, up, direction);
        Vec3<Real> p = hull_.point_along(wi);
        // From this distance on, rounding of the direction moves the point by at most 128 roundings of its distance.
        const auto apart = abs(hull_.plane.distance) > Real(power_of_two<Scalar>(-7)) * hull_.plane.farthest;
        const auto reached = measure_ > Real(kEpsilon);
        if (!all(apart & reached)) {
            // A direction that is almost in the plane does not tell where it meets the light. The point on the image does.
            const Vec3<Real> image_point = inverse_minor_ * Horizons::lifted(ltc_.to_shading(sampled.p));
            const Vec3<Real> on_light = hull_.moved_to_plane(image_point);
            // Next to the horizon of the lobe, rounding turns the direction away from the light: the less of the lobe
            // reaches the light, the more often. A direction may pass its point by some roundings over the squared sine of
            // its angle with the plane: 48 of the farthest vertex are no more than 84 of the largest coordinate, which is
            // what the project requires of hit points in general.
            const Vec3<Real> beside = cross(direction, on_light);
            const Real to_plane = dot(hull_.plane.normal, direction);
            const Real squared_sine =
                min(to_plane * to_plane, hull_.plane.distance * hull_.plane.distance /
                                             max(dot(on_light, on_light), Real(kTiny<Scalar>)));
            const Real largest = Real(48 * kEpsilon) * hull_.plane.farthest;
            const auto ahead = dot(direction, on_light) >= Real(0);
            const auto close = squared_sine * squared_sine * dot(beside, beside) <= largest * largest;
            const auto sound = (ahead & close) | (reached & apart);
            wi = select(sound | dark, wi, normalize(on_light));
            p = select(sound & apart, p, on_light);
        }
        return {wi, pdf(wi), inverse_scale_ * p};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Real density = ltc_.density(wi) * inverse_measure_;
        return select(is_finite(density), density, Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light. See PolygonProjectedSolidAngle.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        return image_.invert(normalize(ltc_.to_cosine(wi)));
    }

    /// Integral of the lobe over the light, in [0, 1].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    NUSSELT_HD PolygonLtc(const PolygonPart<Real, kVertices>& part, const Ltc<Real>& ltc) noexcept
        : ltc_(ltc),
          image_(to_cosine_space(part.polygon, ltc)),
          hull_(hull_of(part.polygon, part.plane_distance)),
          inverse_minor_(Real(1) / ltc.minor()),
          inverse_scale_(part.inverse_scale) {
        const auto in_lobe = image_.measure() > Real(0);
        const auto lit = in_lobe & (hull_.plane.distance != Real(0));
        measure_ = select(lit, Real(1 / kPi<scalar_t<Real>>) * image_.measure(), Real(0));
        inverse_measure_ = select(lit, Real(1) / select(lit, measure_, Real(1)), Real(0));
    }

    Ltc<Real> ltc_;
    Image image_; ///< in cosine space

    // The part of the light that counts, in shading space and scaled to an extent of order one.
    PolygonHull<Real> hull_;
    Real inverse_minor_; ///< takes the scale of Ltc::to_shading() back
    Real inverse_scale_; ///< a power of two

    Real measure_;
    Real inverse_measure_; ///< 0 without light

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.ltc_, self.image_, self.hull_, self.inverse_minor_, self.inverse_scale_, self.measure_,
              self.inverse_measure_);
    }
};

/// Samples are never below the surface: wi.z is not negative (Sec. 4.1 leaves that out for its cost).
template <class Real, int N>
using PolygonClippedLtc = PolygonLtc<Real, N, BothHorizons>;

/// Samples deviate from their density as those of PolygonProjectedSolidAngleBiased do; measure() and pdf() do not.
template <class Real, int N>
using PolygonLtcBiased = PolygonLtc<Real, N, CosineHorizon, PolygonProjectedSolidAngleBiased<Real, N>>;

NUSSELT_NAMESPACE_END
