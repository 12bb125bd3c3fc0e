#pragma once
/// A published method, to compare with: an area-preserving map from the square to the spherical ellipse of a disk.
///
/// I. Guillén, C. Ureña, A. King, M. Fajardo, I. Georgiev, J. López-Moreno, A. Jarabo 2017, Area-Preserving Parameterizations for
/// Spherical Ellipses, CGF 36(4), doi:10.1111/cgf.13234, the radial map: the solid angle of a sector of the ellipse is an incomplete
/// elliptic integral, which is inverted for the angle in a quadrant; along the radius the height over the tangent plane is uniform.
///
/// Deviations: the sector's solid angle, a difference of elliptic integrals of the first and third kind that cancels for small
/// lights, is a quadrature of the positive integrand 1 / (1 + w) with w the height of the rim. Newton's method takes the place of
/// bisection or a table. Ellipses, spheres and ellipsoids are spherical ellipses, too.
/// Known failures: cost; ConeSolidAngle interpolates the same density instead.

#include <nusselt/cones/round_lights.h>
#include <nusselt/core/gauss_legendre.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many samples
///               of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure().
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no extent, seen edge-on, the origin inside: pdf = 0, measure 0.
template <class Real, template <class> class Light>
class ConeSolidAngleGuillen {
    using Scalar = scalar_t<Real>;
    static constexpr int kNodes = kIsSingle<Real> ? 8 : 20; ///< of the quadrature
    static constexpr int kSteps = kIsSingle<Real> ? 3 : 5;  ///< of Newton's method

public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit ConeSolidAngleGuillen(const Light<Real>& light) noexcept
        : view_(view_of(light, detail::SameSpace())) {
        const EllipticCone<Real>& cone = view_.cone;
        const Real a1 = detail::hypotenuse(cone.a, cone.c), b1 = detail::hypotenuse(cone.b, cone.c);
        sine_ = {detail::over_positive(cone.a, a1), detail::over_positive(cone.b, b1)};
        cosine_ = {detail::over_positive(cone.c, a1), detail::over_positive(cone.c, b1)};
        quadrant_ = sector(Real(1));
        const Real measure = Real(2 * kPi<Scalar>) * (sine_.x * sine_.y) * quadrant_;
        const Real inverse = Real(1) / select(measure > Real(0), measure, Real(1));
        const auto lit = cone.is_visible & !view_.is_open() & (measure > Real(0)) & is_finite(inverse);
        measure_ = select(lit, measure, Real(0));
        inverse_measure_ = select(lit, inverse, Real(0));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit ConeSolidAngleGuillen(const ConeSolidAngleGuillen<Single, Light>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, u.y leads away from it. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Real turns = Real(4) * u.x;
        const Real quadrant = min(floor(turns), Real(3));
        const auto mirrored = (quadrant == Real(1)) | (quadrant == Real(3));
        const Real inside = turns - quadrant;
        const Real share = select(mirrored, Real(1) - inside, inside);
        Real x = share;
        NUSSELT_UNROLL
        for (int i = 0; i < kSteps; ++i) {
            const auto turn = sincos_quarter_turn(Real(kPi<Scalar> / 2) * x);
            x = min(max(x - (sector(x) - share * quadrant_) / drop(turn.cos, turn.sin), Real(0)), Real(1));
        }
        const auto turn = sincos_quarter_turn(Real(kPi<Scalar> / 2) * x);
        const auto left = (quadrant == Real(1)) | (quadrant == Real(2));
        const Vec2<Real> direction{select(left, -turn.cos, turn.cos),
                                   select(quadrant >= Real(2), -turn.sin, turn.sin)};
        const Real p = sine_.x * turn.cos, q = sine_.y * turn.sin;
        const Real squared = multiply_add(p, p, q * q);
        const Real fall = u.y * drop(turn.cos, turn.sin);
        const Real radius = sqrt(max(fall * (Real(2) - squared * fall), Real(0)));
        const Real cosine = Real(1) - squared * fall;
        const EllipticCone<Real>& cone = view_.cone;
        const Vec3<Real> sampled = (radius * sine_.x * direction.x) * cone.e1 +
                                   (radius * sine_.y * direction.y) * cone.e2 + cosine * cone.e3;
        const Vec3<Real> wi = select(measure_ > Real(0), sampled, Vec3<Real>{Real(0), Real(0), Real(1)});
        const Real inverse = detail::over_positive(radius, cosine);
        const Vec2<Real> disk{inverse * cosine_.x * direction.x, inverse * cosine_.y * direction.y};
        const Real distance = max(dot(wi, view_.point(disk, wi)), Real(0));
        return {wi, inverse_measure_, (view_.inverse_scale * distance) * wi};
    }

    /// Constant on the light; the caller knows that wi hits it.
    NUSSELT_HD Real pdf(const Vec3<Real>&) const noexcept { return inverse_measure_; }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Real along_x = dot(wi, view_.cone.e1), along_y = dot(wi, view_.cone.e2);
        const Real x = detail::over_positive(abs(along_x), sine_.x);
        const Real y = detail::over_positive(abs(along_y), sine_.y);
        const Real radius = detail::hypotenuse(x, y);
        const Real inverse = detail::over_positive(Real(1), radius);
        const Real cosine = select(inverse > Real(0), x * inverse, Real(1)), sine = y * inverse;
        const Real share =
            detail::over_positive(sector(Real(2 / kPi<Scalar>) * atan2_positive(sine, cosine)), quadrant_);
        const auto left = along_x < Real(0), low = along_y < Real(0);
        const Real turns =
            select(low, select(left, Real(2) + share, Real(4) - share), select(left, Real(2) - share, share));
        const Real fall = detail::over_positive(radius * radius, Real(1) + dot(wi, view_.cone.e3));
        return {below_one(Real(0.25) * turns), below_one(fall / drop(cosine, sine))};
    }

    /// Solid angle of the light [sr].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    /// By how much the cosine falls from the axis to the rim, over the squared sine there.
    NUSSELT_HD Real drop(const Real& cosine, const Real& sine) const noexcept {
        return Real(1) / (Real(1) + detail::hypotenuse(cosine_.x * cosine, cosine_.y * sine));
    }
    /// The integral of drop() from 0 to a share of a quarter turn.
    NUSSELT_HD Real sector(const Real& share) const noexcept {
        constexpr GaussLegendre<Scalar, kNodes> kRule;
        Real sum = Real(0);
        for (int i = 0; i < kNodes; ++i) {
            const auto turn =
                sincos_quarter_turn(min(share, Real(1)) * Real(kPi<Scalar> / 2 * kRule.node(i)));
            sum = multiply_add(Real(kRule.weight(i)), drop(turn.cos, turn.sin), sum);
        }
        return share * sum;
    }

    LightView<Light<Real>> view_;
    Vec2<Real> sine_, cosine_; ///< of the half-angles
    Real quadrant_, measure_, inverse_measure_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.view_, self.sine_, self.cosine_, self.quadrant_, self.measure_, self.inverse_measure_);
    }
};

NUSSELT_NAMESPACE_END
