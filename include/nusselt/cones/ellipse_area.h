#pragma once
/// Sampling of disks and ellipses uniformly by area: for references, and to compare with.

#include <nusselt/cones/round_lights.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam Light Disk or Ellipse.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], squared distance over area times cosine at the
/// light.
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no area, or the origin in the plane of the light: pdf = 0.
template <class Real, template <class> class Light = Ellipse>
class EllipseArea {
    using Scalar = scalar_t<Real>;

public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit EllipseArea(const Light<Real>& light) noexcept {
        const Ellipse<Real> ellipse = ellipse_of(light);
        const Real extent =
            max(max(detail::largest_component(ellipse.center), detail::largest_component(ellipse.u)),
                detail::largest_component(ellipse.v));
        const Real scale = reciprocal_power_of_two(extent);
        inverse_scale_ = reciprocal_power_of_two(scale);
        scaled_ = {scale * ellipse.center, scale * ellipse.u, scale * ellipse.v};
        const Vec3<Real> area = cross(scaled_.u, scaled_.v);
        const Real size = length(area);
        normal_ = normalize(area);
        const Real area_of_unit = Real(kPi<Scalar>) * size;
        measure_ =
            min(area_of_unit * inverse_scale_ * inverse_scale_, Real(std::numeric_limits<Scalar>::max()));
        // Areas below the smallest number are none.
        area_ = select(measure_ > Real(0), area_of_unit, Real(0));
        plane_ = dot(normal_, scaled_.center);
        const Real inverse = detail::over_positive(Real(1), size);
        to_u_ = inverse * cross(scaled_.v, normal_);
        to_v_ = inverse * cross(normal_, scaled_.u);
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit EllipseArea(const EllipseArea<Single, Light>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the centre, u.y leads away from it. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto half = sincos_half_turn(Real(kPi<Scalar>) * u.x);
        const Real radius = sqrt(u.y);
        const Real x = radius * (Real(1) - Real(2) * half.sin * half.sin);
        const Real y = Real(2) * radius * half.sin * half.cos;
        const Vec3<Real> p = scaled_.center + (x * scaled_.u + y * scaled_.v);
        const Vec3<Real> direction = normalize(p);
        const auto dark = dot(direction, direction) == Real(0);
        const Vec3<Real> wi = select(dark, Vec3<Real>{Real(0), Real(0), Real(1)}, direction);
        const Real density = detail::area_density(length(p), area_ * abs(dot(normal_, wi)));
        return {wi, select(dark | (plane_ == Real(0)), Real(0), density), inverse_scale_ * p};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Real cosine = dot(normal_, wi);
        return detail::area_density(detail::over_positive(abs(plane_), abs(cosine)), area_ * abs(cosine));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Real cosine = dot(normal_, wi);
        const Real distance = detail::over_positive(abs(plane_), abs(cosine));
        const Vec3<Real> offset = distance * wi - scaled_.center;
        const Real x = dot(offset, to_u_), y = dot(offset, to_v_);
        const Real angle = atan2_positive(abs(y), x);
        const Real turn = select(y < Real(0), Real(2 * kPi<Scalar>) - angle, angle);
        return {below_one(Real(1 / (2 * kPi<Scalar>)) * turn), below_one(multiply_add(x, x, y * y))};
    }

    /// Area of the light [m^2].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    NUSSELT_HD static const Ellipse<Real>& ellipse_of(const Ellipse<Real>& light) noexcept { return light; }
    NUSSELT_HD static Ellipse<Real> ellipse_of(const Disk<Real>& light) noexcept {
        const Frame<Real> frame = Frame<Real>::from_normal(light.normal);
        return {light.center, light.radius * frame.t, light.radius * frame.b};
    }

    Ellipse<Real> scaled_;            ///< to an extent of order one
    Real inverse_scale_;              ///< a power of two
    Vec3<Real> normal_, to_u_, to_v_; ///< unit; from points to shares of the semi-diameters
    Real measure_;                    ///< [m^2]
    Real area_, plane_;               ///< area and distance of the plane, scaled

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.scaled_.center, self.scaled_.u, self.scaled_.v, self.inverse_scale_, self.normal_,
              self.to_u_, self.to_v_, self.measure_, self.area_, self.plane_);
    }
};

/// The technique for disks.
template <class Real>
using DiskArea = EllipseArea<Real, Disk>;

NUSSELT_NAMESPACE_END
