#pragma once
/// Sampling of an elliptic cone above the horizon in proportion to the cosine at the surface.
///
/// Derived here. Directions are projected along the axis of the cone, not along the normal. There the cone is exactly
/// an ellipse, and the cosine times the solid angle is n3 plus an odd function times the area. So each wedge between
/// two diameters has the share of its area, the angle is uniform, and only the signed radius needs an equation,
///
///     r^2 (1 + zeta r Phi(m r)) = |kappa|,  Phi(y) = (asin(y) - y sqrt(1 - y^2)) / y^3,
///
/// with an odd term that is a correction of the order of the angular size. The measure is that of E. Heitz and S. Hill
/// 2017, Linear-Light Shading with Linearly Transformed Cosines, for ellipses: the cosine of the axis times pi alpha
/// beta.

#include <nusselt/cones/cone_parts.h>
#include <nusselt/cones/cone_sweep.h>
#include <nusselt/cones/elliptic_cone.h>

NUSSELT_NAMESPACE_BEGIN

/// Whether the horizon z = 0 does not cut a cone that is above it, but for rounding.
template <class Real>
NUSSELT_INLINE mask_t<Real> is_above_horizon(const EllipticCone<Real>& cone) noexcept {
    const Vec3<Real> height = detail::heights_of_axes(cone);
    return height.z * cone.c >= detail::hypotenuse(height.x * cone.a, height.y * cone.b);
}

/// \tparam Real float, double, long double or a pack.
/// \tparam Steps of the iteration for the radius. The backward error is 2.7e-2 without a step, 7.8e-4 after one, 9.8e-8
/// after two and 2e-15 after three, in units of u.y, for any cone.
template <class Real, int Steps>
class WholeCone {
    using Scalar = scalar_t<Real>;

public:
    WholeCone() = default;

    /// \param cone above the horizon; others give any density.
    NUSSELT_HD explicit WholeCone(const EllipticCone<Real>& cone) noexcept
        : e1_(cone.e1), e2_(cone.e2), e3_(cone.e3) {
        const Real a1 = detail::over_positive(Real(1), detail::hypotenuse(cone.a, cone.c));
        const Real b1 = detail::over_positive(Real(1), detail::hypotenuse(cone.b, cone.c));
        alpha_ = a1 * cone.a;
        beta_ = b1 * cone.b;
        disk_per_radius_ = {a1 * cone.c, b1 * cone.c};
        // Rounding chooses the axes of nearly circular cones, so that the turn starts at the x-axis instead.
        const Real across = detail::hypotenuse(e1_.x, e2_.x);
        start_ = {select(across > Real(0), detail::over_positive(e1_.x, across), Real(1)),
                  detail::over_positive(e2_.x, across)};
        const auto rises = e3_.z > Real(0);
        const Real inverse = Real(1) / select(rises, e3_.z, Real(1));
        odd_ = {e1_.z * alpha_ * inverse, e2_.z * beta_ * inverse};
        const auto measure =
            cone_measure(Real(kPi<Scalar>) * (alpha_ * beta_) * e3_.z, mask_t<Real>(rises & cone.is_visible));
        measure_ = measure.value;
        inverse_measure_ = measure.inverse;
    }

    template <class Single>
    NUSSELT_HD explicit WholeCone(const WholeCone<Single, Steps>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, from the x-axis, u.y leads from one side of the cone to the
    /// other. Continuous in both.
    NUSSELT_HD ConeSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto turn = sincos_half_turn(Real(kPi<Scalar>) * u.x);
        const Vec2<Real> direction{start_.x * turn.cos - start_.y * turn.sin,
                                   start_.y * turn.cos + start_.x * turn.sin};
        const Ray ray = ray_at(direction);
        const Real kappa = multiply_add(Real(2), u.y, Real(-1)) + ray.eta * ray.ratio;
        const Real zeta = select(kappa < Real(0), -ray.eta, ray.eta);
        const Real goal = min(abs(kappa), multiply_add(zeta, ray.ratio, Real(1)));
        const Real radius = solve(ray, zeta, goal);
        const Real r = select(kappa < Real(0), -radius, radius);
        const Real z = complement_of(ray, radius);
        const Vec3<Real> wi = (r * alpha_ * direction.x) * e1_ + (r * beta_ * direction.y) * e2_ + z * e3_;
        const Real inverse = detail::over_positive(r, z);
        return {wi, {disk_per_radius_.x * direction.x * inverse, disk_per_radius_.y * direction.y * inverse}};
    }

    /// The density of directions in the cone over their cosine [1/sr].
    NUSSELT_HD const Real& density_per_cosine() const noexcept { return inverse_measure_; }

    /// The random numbers for which sample() returns a unit direction in the cone.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Real e1 = dot(wi, e1_), e2 = dot(wi, e2_);
        const Vec2<Real> end{copysign(detail::over_positive(abs(e1), alpha_), e1),
                             copysign(detail::over_positive(abs(e2), beta_), e2)};
        const Real length = detail::hypotenuse(end.x, end.y);
        const Real inverse = detail::over_positive(Real(1), length);
        const Vec2<Real> direction{select(inverse > Real(0), end.x * inverse, start_.x),
                                   select(inverse > Real(0), end.y * inverse, start_.y)};
        // The half of the turn to which the diameter belongs.
        const Real sine = start_.x * direction.y - start_.y * direction.x;
        const Real sign = select(sine < Real(0), Real(-1), Real(1));
        const Real angle = atan2_positive(abs(sine), sign * dot(start_, direction));
        const Ray ray = ray_at(sign * direction);
        const Real f = value(ray, sign * ray.eta, min(length, Real(1)));
        return {below_one(Real(1 / kPi<Scalar>) * angle),
                below_one(Real(0.5) * (Real(1) + (sign * f - ray.eta * ray.ratio)))};
    }

    /// Projected solid angle [sr].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    struct Ray {
        Real extent; ///< m, the largest sine of the angle from the axis
        Real rim;    ///< the least cosine of it
        Real eta;    ///< weight of the odd term
        Real ratio;  ///< Phi(m)
    };

    /// (asin(y) - y sqrt(1 - y^2)) / y^3 for y in [0, 1].
    NUSSELT_HD static Real segment_ratio(const Real& y, const Real& complement) noexcept {
        // This is the cycloid for twice the angle asin(y), over the sine.
        const Real angle = atan2_positive(y, complement);
        const CycloidRatio<Real> ratio = cycloid_ratio(angle, y, complement);
        const Real cosine = select(ratio.is_small, complement, Real(1));
        return Real(0.5) * ratio.value / (cosine * cosine * cosine);
    }

    /// The cosine of the angle from the axis at a radius in [0, 1], accurate relative to itself for wide cones, too.
    NUSSELT_HD static Real complement_of(const Ray& ray, const Real& r) noexcept {
        const Real at_rim = ray.rim * r;
        return sqrt(multiply_add(at_rim, at_rim, (Real(1) - r) * (Real(1) + r)));
    }

    NUSSELT_HD Ray ray_at(const Vec2<Real>& direction) const noexcept {
        const Real x = alpha_ * direction.x, y = beta_ * direction.y;
        const Real extent = min(detail::hypotenuse(x, y), Real(1));
        const Real u = disk_per_radius_.x * direction.x, v = disk_per_radius_.y * direction.y;
        const Real rim = sqrt(multiply_add(u, u, v * v));
        return {extent, rim, multiply_add(odd_.x, direction.x, odd_.y * direction.y),
                segment_ratio(extent, rim)};
    }

    NUSSELT_HD static Real value(const Ray& ray, const Real& zeta, const Real& r) noexcept {
        const Real y = min(ray.extent * r, Real(1));
        return r * r * multiply_add(zeta * r, segment_ratio(y, complement_of(ray, r)), Real(1));
    }

    /// The radius in [0, 1] for which value() is the goal.
    NUSSELT_HD static Real solve(const Ray& ray, const Real& zeta, const Real& goal) noexcept {
        // The start is exact at both ends. Steps go to the root of Taylor's polynomial of degree two, in Blinn's form.
        const Real z = zeta * ray.ratio;
        const Real sum = max(Real(1) + z, Real(std::numeric_limits<Scalar>::epsilon()));
        const Real guess = min(sqrt(goal / sum), Real(1));
        const Real blend = max(multiply_add(z, guess, Real(1)), Real(std::numeric_limits<Scalar>::epsilon()));
        Real r = min(sqrt(goal / blend), Real(1));
        NUSSELT_UNROLL
        for (int i = 0; i < Steps; ++i) {
            const Real w = max(complement_of(ray, r), Real(power_of_two<Scalar>(-30)));
            const Real inverse = Real(1) / w;
            const Real f = value(ray, zeta, r) - goal;
            const Real slope = Real(2) * r * max(multiply_add(zeta * r, inverse, Real(1)), Real(0));
            const Real curve = multiply_add(
                Real(2) * zeta * r, multiply_add(w, w, Real(1)) * (inverse * inverse * inverse), Real(2));
            const Real root = sqrt(max(multiply_add(slope, slope, Real(-2) * f * curve), Real(0)));
            r = min(max(r - Real(2) * detail::over_positive(f, slope + root), Real(0)), Real(1));
        }
        return r;
    }

    Vec3<Real> e1_, e2_, e3_;
    Real alpha_, beta_;          ///< of the ellipse that is the projection along the axis
    Vec2<Real> disk_per_radius_; ///< the disk of the cone per disk of the ellipse, both divided by the cosine
    Vec2<Real> odd_;
    Vec2<Real> start_; ///< of the turn, a unit vector
    Real measure_, inverse_measure_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.e1_, self.e2_, self.e3_, self.alpha_, self.beta_, self.disk_per_radius_, self.odd_,
              self.start_, self.measure_, self.inverse_measure_);
    }
};

NUSSELT_NAMESPACE_END
