#pragma once
/// The map from the unit square to the directions of a spherical ellipse, which techniques by solid angle share. They
/// differ in how they turn around the axis.
///
/// Projected along its axis, an elliptic cone is an ellipse. Along each of its radii, the cosine of the angle from the
/// axis is uniform up to the rim, where it is w. The density of the angle around the axis, the drop, is proportional to
/// 1 / (1 + w).

#include <nusselt/cones/round_lights.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// The drop at the rim of a cone: by how much the cosine falls from the axis to the rim, over the squared sine there.
template <class Real>
struct RimDrop {
    Vec2<Real> cosine;    ///< of the half-angles
    mask_t<Real> is_open; ///< whether the light surrounds the origin: the cosine then falls to -1

    RimDrop() = default;
    /// \param half_angles their cosines.
    /// \param open       whether the light surrounds the origin.
    NUSSELT_HD RimDrop(const Vec2<Real>& half_angles, const mask_t<Real>& open) noexcept
        : cosine(half_angles), is_open(open) {}
    template <class Single>
    NUSSELT_HD explicit RimDrop(const RimDrop<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// At a turn around the axis, given as the angle on the unit circle of which the rim is an image.
    NUSSELT_HD Real operator()(const Real& cosine_of_turn, const Real& sine_of_turn) const noexcept {
        const Real w = detail::hypotenuse(cosine.x * cosine_of_turn, cosine.y * sine_of_turn);
        return select(is_open, Real(2), Real(1) / (Real(1) + w));
    }

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.cosine, self.is_open);
    }
};

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
/// \tparam Turn  the distribution of the turn around the axis within a quadrant. It is made from a RimDrop.
///               drop(cosine, sine) and integral() are the drop and its integral over the quadrant, as shares in
///               [0, 1]; invert(share) leads to the part of the quadrant below which a share of the integral is, and
///               below(part) back; weight(part, cosine, sine) is the density of invert() over the drop, and kIsExact
///               says that it is 1.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr].
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no extent, seen edge-on, an ellipsoid without volume: pdf = 0, measure 0. From inside a sphere or an
/// ellipsoid, all directions lead to its surface.
/// Rounding may leave a sliver of a light seen edge-on, with a tiny measure.
template <class Real, template <class> class Light, template <class> class Turn>
class SphericalEllipse {
    using Scalar = scalar_t<Real>;

public:
    SphericalEllipse() = default;

    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit SphericalEllipse(const Light<Real>& light) noexcept
        : view_(view_of(light, detail::SameSpace())) {
        const EllipticCone<Real>& cone = view_.cone;
        const Real a1 = detail::hypotenuse(cone.a, cone.c), b1 = detail::hypotenuse(cone.b, cone.c);
        sine_ = {detail::over_positive(cone.a, a1), detail::over_positive(cone.b, b1)};
        cosine_ = {detail::over_positive(cone.c, a1), detail::over_positive(cone.c, b1)};
        turn_ = Turn<Real>(RimDrop<Real>(cosine_, view_.is_open()));
        const Real measure = Real(2 * kPi<Scalar>) * (sine_.x * sine_.y) * turn_.integral();
        const Real inverse = Real(1) / select(measure > Real(0), measure, Real(1));
        const auto lit = cone.is_visible & (measure > Real(0)) & is_finite(inverse);
        measure_ = select(lit, measure, Real(0));
        inverse_measure_ = select(lit, inverse, Real(0));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit SphericalEllipse(const SphericalEllipse<Single, Light, Turn>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, u.y leads away from it. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        // Quadrants two and four are mirrored.
        const Real turns = Real(4) * u.x;
        const Real quadrant = min(floor(turns), Real(3));
        const Real inside = turns - quadrant;
        const auto mirrored = (quadrant == Real(1)) | (quadrant == Real(3));
        const Real x = turn_.invert(select(mirrored, Real(1) - inside, inside));
        const auto turn = sincos_quarter_turn(Real(kPi<Scalar> / 2) * x);
        const auto left = (quadrant == Real(1)) | (quadrant == Real(2));
        const Vec2<Real> direction{select(left, -turn.cos, turn.cos),
                                   select(quadrant >= Real(2), -turn.sin, turn.sin)};

        // The cosine of the angle from the axis is uniform; its complement keeps small angles apart.
        const Real squared = squared_sine(turn.cos, turn.sin);
        const Real fall = u.y * turn_.drop(turn.cos, turn.sin);
        const Real radius = sqrt(max(fall * (Real(2) - squared * fall), Real(0)));
        const Real cosine = Real(1) - squared * fall;
        const EllipticCone<Real>& cone = view_.cone;
        const Vec3<Real> sampled = (radius * sine_.x * direction.x) * cone.e1 +
                                   (radius * sine_.y * direction.y) * cone.e2 + cosine * cone.e3;
        const Vec3<Real> wi = select(measure_ > Real(0), sampled, Vec3<Real>{Real(0), Real(0), Real(1)});
        const Real inverse = detail::over_positive(radius, cosine);
        const Vec2<Real> disk{inverse * cosine_.x * direction.x, inverse * cosine_.y * direction.y};
        const Real distance = max(dot(wi, view_.point(disk, wi)), Real(0));
        return {wi, pdf(wi), (view_.inverse_scale * distance) * wi};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf([[maybe_unused]] const Vec3<Real>& wi) const noexcept {
        if constexpr (Turn<Real>::kIsExact) {
            return inverse_measure_;
        } else {
            const Place place = place_of(wi);
            const Real density = turn_.weight(place.x, place.cosine, place.sine) * inverse_measure_;
            return select(is_finite(density), density, Real(0));
        }
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Place place = place_of(wi);
        const Real share = detail::over_positive(turn_.below(place.x), turn_.integral());
        const auto left = dot(wi, view_.cone.e1) < Real(0);
        const auto low = dot(wi, view_.cone.e2) < Real(0);
        const Real turns =
            select(low, select(left, Real(2) + share, Real(4) - share), select(left, Real(2) - share, share));
        const Real up = Real(1) + dot(wi, view_.cone.e3);
        // 1 - cosine over the squared sine at the rim is the squared radius over 1 + cosine.
        const Real fall =
            select(view_.is_open(), Real(2) - up, detail::over_positive(place.radius * place.radius, up));
        return {below_one(Real(0.25) * turns), below_one(fall / turn_.drop(place.cosine, place.sine))};
    }

    /// Solid angle of the light [sr], as exact as the integral of the turn.
    NUSSELT_HD Real measure() const noexcept { return measure_; }

    /// How the origin sees the light.
    NUSSELT_HD const LightView<Light<Real>>& view() const noexcept { return view_; }

private:
    /// A direction in the quadrant of positive coordinates.
    struct Place {
        Real x, cosine, sine, radius;
    };

    NUSSELT_HD Place place_of(const Vec3<Real>& wi) const noexcept {
        const Real x = detail::over_positive(abs(dot(wi, view_.cone.e1)), sine_.x);
        const Real y = detail::over_positive(abs(dot(wi, view_.cone.e2)), sine_.y);
        const Real radius = detail::hypotenuse(x, y);
        const Real inverse = detail::over_positive(Real(1), radius);
        const Real angle = Real(2 / kPi<Scalar>) * atan2_positive(y, x);
        return {min(angle, Real(1)), select(inverse > Real(0), x * inverse, Real(1)), y * inverse, radius};
    }

    NUSSELT_HD Real squared_sine(const Real& cosine, const Real& sine) const noexcept {
        const Real x = sine_.x * cosine, y = sine_.y * sine;
        return min(multiply_add(x, x, y * y), Real(1));
    }

    LightView<Light<Real>> view_;
    Vec2<Real> sine_, cosine_; ///< of the half-angles
    Turn<Real> turn_;
    Real measure_, inverse_measure_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.view_, self.sine_, self.cosine_, self.turn_, self.measure_, self.inverse_measure_);
    }
};

NUSSELT_NAMESPACE_END
