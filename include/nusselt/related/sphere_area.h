#pragma once
/// To compare with: sampling of a whole sphere uniformly by area. Half of the samples and more are on the side that the point does
/// not see.

#include <nusselt/cones/round_lights.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or many samples
///              of one light (see the broadcasting constructor).
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], squared distance over area times cosine at the light, for
/// the point of the sphere that faces the origin.
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no radius, or the origin inside: pdf = 0. Samples on the far side have a pdf of 0, and count.
template <class Real>
class SphereArea {
    using Scalar = scalar_t<Real>;

public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit SphereArea(const Sphere<Real>& light) noexcept {
        const Real scale =
            reciprocal_power_of_two(max(detail::largest_component(light.center), light.radius));
        center_ = scale * light.center;
        radius_ = scale * light.radius;
        inverse_scale_ = reciprocal_power_of_two(scale);
        const Real distance = length(center_);
        const auto outside = (radius_ > Real(0)) & (distance > radius_);
        area_ = select(outside, Real(4 * kPi<Scalar>) * radius_ * radius_, Real(0));
        gap_ = (distance - radius_) * (distance + radius_);
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit SphereArea(const SphereArea<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the z-axis, u.y leads from the highest to the lowest point.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto half = sincos_half_turn(Real(kPi<Scalar>) * u.x);
        const Real sine = Real(2) * sqrt(u.y * (Real(1) - u.y));
        const Vec3<Real> outwards{sine * (Real(1) - Real(2) * half.sin * half.sin),
                                  Real(2) * sine * half.sin * half.cos, Real(1) - Real(2) * u.y};
        const Vec3<Real> p = center_ + radius_ * outwards;
        const Vec3<Real> direction = normalize(p);
        const auto dark = (dot(direction, direction) == Real(0)) | !(area_ > Real(0));
        const Vec3<Real> wi = select(dark, Vec3<Real>{Real(0), Real(0), Real(1)}, direction);
        // Rounding next to the rim must not make a point of the far side one of the near side.
        const Real facing = -dot(outwards, wi);
        return {wi, select(dark, Real(0), detail::area_density(length(p), area_ * facing)),
                inverse_scale_ * p};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Hit hit = intersect(wi);
        return detail::area_density(hit.distance, area_ * hit.cosine);
    }

    /// The random numbers for which sample() returns wi and the point that faces the origin.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> outwards = normalize(intersect(wi).distance * wi - center_);
        const Real angle = atan2_positive(abs(outwards.y), outwards.x);
        const Real turn = select(outwards.y < Real(0), Real(2 * kPi<Scalar>) - angle, angle);
        return {below_one(Real(1 / (2 * kPi<Scalar>)) * turn), below_one(Real(0.5) * (Real(1) - outwards.z))};
    }

    /// Area of the sphere [m^2], 0 from inside.
    NUSSELT_HD Real measure() const noexcept { return area_ * inverse_scale_ * inverse_scale_; }

private:
    struct Hit {
        Real distance, cosine; ///< cosine at the light
    };
    NUSSELT_HD Hit intersect(const Vec3<Real>& wi) const noexcept {
        const Real along = dot(wi, center_);
        const Vec3<Real> off = center_ - along * wi;
        const Real root = sqrt(max(radius_ * radius_ - dot(off, off), Real(0)));
        return {detail::over_positive(gap_, along + root), detail::over_positive(root, radius_)};
    }

    Vec3<Real> center_; ///< scaled to an extent of order one
    Real radius_, area_;
    Real gap_; ///< squared distance of the centre minus squared radius
    Real inverse_scale_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.center_, self.radius_, self.area_, self.gap_, self.inverse_scale_);
    }
};

NUSSELT_NAMESPACE_END
