#pragma once
/// A published method, to compare with: uniform sampling of the circular cone of a sphere, as most renderers do it.
///
/// C. Wang 1992, Physically correct direct lighting for distribution ray tracing, Graphics Gems III, pp. 307-313; P. Shirley,
/// C. Wang, K. Zimmerman 1996, Monte Carlo techniques for direct lighting calculations, ACM TOG 15(1), Sec. 3.2: the cosine of the
/// angle from the axis and the angle around it are uniform.
///
/// Deviations: instead of the cosine, one minus the cosine is uniform, which keeps small spheres apart from their centre; at the
/// rim it is the squared sine over one plus the cosine. The hit point is the product of both distances of the ray over the larger
/// one, which does not cancel for far spheres.
/// Known failures: none. ConeSolidAngle has the same density, and also the inside of spheres and the point in the disk of the cone.

#include <nusselt/cones/round_lights.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or many samples
///              of one light (see the broadcasting constructor).
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure().
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no radius, or the origin inside: pdf = 0, measure 0.
template <class Real>
class SphereSolidAngleWang {
    using Scalar = scalar_t<Real>;

public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit SphereSolidAngleWang(const Sphere<Real>& light) noexcept {
        const Real scale =
            reciprocal_power_of_two(max(detail::largest_component(light.center), light.radius));
        inverse_scale_ = reciprocal_power_of_two(scale);
        const Vec3<Real> center = scale * light.center;
        radius_ = scale * light.radius;
        distance_ = length(center);
        const auto outside = (radius_ > Real(0)) & (distance_ > radius_);
        const Real inverse = Real(1) / select(outside, distance_, Real(1));
        frame_ = Frame<Real>::from_normal(
            select(outside, inverse * center, Vec3<Real>{Real(0), Real(0), Real(1)}));
        gap_ = (distance_ - radius_) * (distance_ + radius_);
        const Real sine = radius_ * inverse;
        const Real cosine = sqrt(max(gap_, Real(0))) * inverse;
        const Real fall = sine * sine / (Real(1) + cosine);
        const Real density = Real(1) / (Real(2 * kPi<Scalar>) * select(fall > Real(0), fall, Real(1)));
        const auto lit = outside & (fall > Real(0)) & is_finite(density);
        fall_ = select(lit, fall, Real(0));
        density_ = select(lit, density, Real(0));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit SphereSolidAngleWang(const SphereSolidAngleWang<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, u.y leads away from it. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto half = sincos_half_turn(Real(kPi<Scalar>) * u.x);
        const Real fall = u.y * fall_;
        const Real sine = sqrt(fall * (Real(2) - fall)), cosine = Real(1) - fall;
        const Vec3<Real> wi = frame_.to_world(
            {sine * (Real(1) - Real(2) * half.sin * half.sin), Real(2) * sine * half.sin * half.cos, cosine});
        const Real off = distance_ * sine;
        const Real root = sqrt(max((radius_ - off) * (radius_ + off), Real(0)));
        const Real away = detail::over_positive(gap_, multiply_add(distance_, cosine, root));
        return {wi, density_, (inverse_scale_ * away) * wi};
    }

    /// Constant on the light; the caller knows that wi hits it.
    NUSSELT_HD Real pdf(const Vec3<Real>&) const noexcept { return density_; }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> local = frame_.to_local(wi);
        const Real angle = atan2_positive(abs(local.y), local.x);
        const Real turn = select(local.y < Real(0), Real(2 * kPi<Scalar>) - angle, angle);
        const Real squared = multiply_add(local.x, local.x, local.y * local.y);
        const Real fall = detail::over_positive(squared, Real(1) + local.z);
        return {below_one(Real(1 / (2 * kPi<Scalar>)) * turn), below_one(detail::over_positive(fall, fall_))};
    }

    /// Solid angle of the sphere [sr].
    NUSSELT_HD Real measure() const noexcept { return Real(2 * kPi<Scalar>) * fall_; }

private:
    Frame<Real> frame_;      ///< its normal is the axis of the cone
    Real radius_, distance_; ///< scaled to an extent of order one
    Real gap_;               ///< squared distance of the centre minus squared radius
    Real fall_;              ///< one minus the cosine of the half-angle
    Real density_, inverse_scale_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.frame_, self.radius_, self.distance_, self.gap_, self.fall_, self.density_,
              self.inverse_scale_);
    }
};

NUSSELT_NAMESPACE_END
