#pragma once
/// The rim of an elliptic cone between two horizons, as a function of z in [-1, 1] for which the measure of a sweep is
/// smooth. See lune_sweep.h.

#include <limits>

#include <nusselt/cones/cycloid.h>
#include <nusselt/cones/elliptic_cone.h>
#include <nusselt/cones/horizon_gaps.h>
#include <nusselt/cones/rim_angles.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack.
///
/// The first horizon is z = 0, the second one a plane through the y-axis. Half-planes through the y-axis turn from the
/// first one to the second one around the pole, that of the two directions of the axis that is closer to the axis of
/// the cone. A cone that touches a horizon up to rounding counts as not cut.
template <class Real>
class LuneMap {
    using Scalar = scalar_t<Real>;

public:
    /// A half-plane and what it has of the cone: the way from the near end, on the rim or at the pole, to the far end
    /// on the rim.
    struct Turn {
        Real z;
        Vec2<Real> far_end, near_end; ///< in the disk of the cone
        Real far_length, near_length; ///< of their directions, which are not of unit length
        Vec2<Real> away;              ///< the half-plane's direction along h and the normal, of unit length
        Real gamma, near_gamma;       ///< angles of both ends from the pole
        Real angle;                   ///< between both ends
        Real half_sine, half_cosine;  ///< of half of it
        Real clearance;               ///< height of the far end's direction above the first horizon
        Real across;                  ///< distance of the far end's direction from the axis of the pole
        Real volume;                  ///< of pole, far end and its derivative, up to a constant
        Real jacobian;                ///< angle in the disk per angle of the map
    };

    LuneMap() = default;

    /// Without a lane that is clipped, only is_clipped() and is_lit() are valid.
    /// \param normal of the second horizon, (x, 0, z), of unit length.
    NUSSELT_HD LuneMap(const EllipticCone<Real>& cone, const Vec3<Real>& normal) noexcept {
        a_ = cone.a;
        b_ = cone.b;
        // Half-spaces count as cones with large angles, for which points of the rim have digits left.
        c_ = max(cone.c, Real(detail::kConeRounding<Real>));
        const auto wide = min(a_, b_) > Real(kTiny<Scalar>);

        // The pole, as a homogeneous point of the disk.
        const Real ahead = select(cone.e3.y < Real(0), Real(-1), Real(1));
        pole_ = {Real(0), ahead, Real(0)};
        const Real side = select(normal.x < Real(0), Real(-1), Real(1));
        h_ = {side, Real(0), Real(0)};
        turn_sign_ = -side * ahead;
        const Real vx = ahead * (b_ * c_) * cone.e1.y, vy = ahead * (a_ * c_) * cone.e2.y;
        const Real vw = ahead * (a_ * b_) * cone.e3.y;
        const Real away = detail::hypotenuse(vx, vy);
        const Real inverse = detail::over_positive(Real(1), max(away, vw));
        pole_scale_ = max(away, vw);
        away_ = away * inverse;
        level_ = vw * inverse;
        // A pole within rounding of the rim counts as one on the rim: there, half-planes on the far side have no end of
        // their own.
        is_inside_ = vw > Real(1 + 256 * std::numeric_limits<Scalar>::epsilon()) * away;
        const auto aside = away > Real(kTiny<Scalar>) * pole_scale_;
        const Real inverse_away = Real(1) / select(aside, away, Real(1));
        farthest_ = {select(aside, -vx * inverse_away, Real(1)), select(aside, -vy * inverse_away, Real(0))};
        tangent_cosine_ =
            select(is_inside_, Real(0), min(level_ / select(is_inside_, Real(1), away_), Real(1)));
        const Real inverse_level = Real(1) / select(is_inside_, vw, Real(1));
        inner_ = {vx * inverse_level, vy * inverse_level};

        basis_h_ = side * Vec3<Real>{cone.e1.x, cone.e2.x, cone.e3.x};
        basis_p_ = ahead * Vec3<Real>{cone.e1.y, cone.e2.y, cone.e3.y};
        basis_n_ = {cone.e1.z, cone.e2.z, cone.e3.z};

        // Where both horizons cut the cone.
        const Real lateral = abs(normal.x);
        const auto second_of = [&](const Real& h, const Real& n) {
            return difference_of_products(lateral, h, -normal.z, n);
        };
        const auto out_of = [&](const Real& h, const Real& n) {
            return difference_of_products(lateral, n, normal.z, h);
        };
        const Vec3<Real> second{second_of(basis_h_.x, basis_n_.x), second_of(basis_h_.y, basis_n_.y),
                                second_of(basis_h_.z, basis_n_.z)};
        const Vec3<Real> out{out_of(basis_h_.x, basis_n_.x), out_of(basis_h_.y, basis_n_.y),
                             out_of(basis_h_.z, basis_n_.z)};
        const Chord first_cut = chord_of(basis_n_, basis_h_), second_cut = chord_of(second, out);
        const auto has_second = lateral > Real(4 * std::numeric_limits<Scalar>::epsilon());
        is_clipped_ = wide & has_second & second_cut.is_met;
        // A cone that only touches the second horizon is on the side of its axis.
        const auto above_first = first_cut.is_met | ((!first_cut.is_cut) & (basis_n_.z > Real(0)));
        const auto above_second = second_cut.is_cut | (second.z > Real(0));
        is_lit_ =
            is_clipped_ | (has_second & above_first & above_second) | ((!has_second) & (normal.z > Real(0)));

        // The map is costly to prepare, and seldom needed.
        if (!any(is_clipped_)) return;

        // Choose the map of the rim.
        angles_ = RimAngles<Real>(a_, b_, c_, farthest_);
        const Real length = length_of(farthest_);
        const Real along = component(farthest_, basis_p_) / length;
        const Real across =
            detail::hypotenuse(component(farthest_, basis_h_), component(farthest_, basis_n_)) / length;
        const Real versine = detail::versine(across, -along);
        angles_.set_stretch(max(Real(0.5) * versine, Real(kTiny<Scalar>)));

        // The rim from the first horizon, or where the first half-plane touches it, to the second horizon.
        starts_at_horizon_ = first_cut.is_met;
        const Real tangent_sine =
            sqrt(max((Real(1) - tangent_cosine_) * (Real(1) + tangent_cosine_), Real(0)));
        const Vec2<Real> touching = from_farthest({-tangent_cosine_, -turn_sign_ * tangent_sine});
        start_ = select(starts_at_horizon_, first_cut.end, touching);
        level_cosine_ = select(starts_at_horizon_, -first_cut.height, -tangent_cosine_);
        level_sine_ = select(starts_at_horizon_, first_cut.half, tangent_sine);
        horizon_ = first_cut.steepness;
        SinCos<Real> half = half_angle_at(start_);
        // A pole on the rim is where half-planes touch, at half a turn from the farthest point: on the side of the
        // start.
        half.sin = copysign(half.sin, select(starts_at_horizon_, half.sin, -turn_sign_));
        begin_ = angles_.angle_of(half);
        const Real inverse_half = Real(1) / detail::hypotenuse(half.sin, half.cos);
        start_sine_ = inverse_half * half.sin;
        start_cosine_ = inverse_half * half.cos;
        start_scale_ = detail::hypotenuse(angles_.stretch * start_cosine_, start_sine_);
        // The length of diag(squeeze, 1) times the unit vector that leads to the start.
        start_squeezed_ = angles_.squeeze / detail::hypotenuse(start_.x, angles_.squeeze * start_.y);
        const Real range = turn_sign_ * (angles_.angle_of(half_angle_at(second_cut.end)) - begin_);
        const auto wraps = is_inside_ & (range < Real(0));
        half_range_ = Real(0.5) * max(select(wraps, range + Real(2 * kPi<Scalar>), range), Real(0));
    }

    template <class Single>
    NUSSELT_HD explicit LuneMap(const LuneMap<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// Whether the second horizon cuts the part of the cone above the first one.
    NUSSELT_HD const mask_t<Real>& is_clipped() const noexcept { return is_clipped_; }
    /// Whether anything of the cone is above both horizons.
    NUSSELT_HD const mask_t<Real>& is_lit() const noexcept { return is_lit_; }
    NUSSELT_HD const Vec3<Real>& pole() const noexcept { return pole_; }
    /// Unit: horizontal, perpendicular to the pole, and above the second horizon.
    NUSSELT_HD const Vec3<Real>& h() const noexcept { return h_; }
    /// The measure of the sweep over the integral of density() over z.
    NUSSELT_HD Real scale() const noexcept { return pole_scale_ * half_range_; }

    /// \param z in [-1, 1]
    NUSSELT_HD Turn turned(const Real& z) const noexcept {
        Turn turn;
        turn.z = z;
        const auto way = sincos_half_turn(half_range_ * (Real(0.5) * (z + Real(1))));
        const Real signed_sine = turn_sign_ * way.sin;
        const Real x = angles_.stretch * (start_cosine_ * way.cos - start_sine_ * signed_sine);
        const Real s = start_sine_ * way.cos + start_cosine_ * signed_sine;
        const auto point = angles_.at(x, s);
        const Vec2<Real> rim = point.inverse_length * point.scaled;
        turn.far_end = rim;
        turn.jacobian = point.jacobian;

        // The angle in the disk from the start, accurate relative to itself.
        const Real per_scale = sqrt(point.inverse_norm) / start_scale_;
        const Real half_sine = angles_.stretch * way.sin * per_scale;
        const Real half_cosine = (x * (angles_.stretch * start_cosine_) + s * start_sine_) * per_scale;
        const Real from_sine =
            angles_.squeeze * Real(2) * half_sine * half_cosine * point.inverse_length / start_squeezed_;
        const Real from_cosine = dot(rim, start_);
        const auto obtuse = from_cosine < Real(0);
        const Real root = sqrt(max(Real(0.5) * (Real(1) + abs(from_cosine)), Real(0.5)));
        const Real other = Real(0.5) * from_sine / root;
        const Real from_half_sine = select(obtuse, root, abs(other));
        const Real from_half_cosine = select(obtuse, other, copysign(root, other));
        const Real gain = Real(2) * from_half_sine *
                          max(level_sine_ * from_half_cosine - level_cosine_ * from_half_sine, Real(0));

        // Heights above the horizon and above the tangent from the pole: one of them vanishes at the start.
        const Real far_cosine = dot(rim, farthest_);
        turn.clearance = max(select(starts_at_horizon_, horizon_ * gain, component(rim, basis_n_)), Real(0));
        const Real volume =
            select(starts_at_horizon_ | is_inside_, multiply_add(away_, far_cosine, level_), away_ * gain);
        turn.volume = max(volume, Real(0));
        add_chord(turn, far_cosine);
        return turn;
    }

    /// The measure of the sweep per z, up to a constant.
    NUSSELT_HD static Real density(const Turn& turn) noexcept {
        const Real swept = measure_up_to(turn, turn.angle, turn.half_sine, turn.half_cosine);
        return turn.clearance * turn.volume * turn.jacobian * swept;
    }

    /// The integral of the squared sine of the angle from the pole, over the cube of the distance of the far end from
    /// the axis.
    /// \param angle from the near end; sine and cosine are those of its half.
    NUSSELT_HD static Real measure_up_to(const Turn& turn, const Real& angle, const Real& half_sine,
                                         const Real& half_cosine) noexcept {
        const Real inverse = detail::over_positive(Real(1), turn.across);
        const Real share = angle * inverse;
        const Real cube =
            cycloid_fraction(Real(0.5) * angle, half_sine, half_cosine) * (share * share * share);
        const Real lever = sincos_half_turn(turn.near_gamma + Real(0.5) * angle).sin * inverse;
        return multiply_add(Real(Scalar(1) / 12), cube,
                            Real(2) * half_sine * half_cosine * inverse * (lever * lever));
    }

    /// The place z in [-1, 1] at which the half-plane of a direction meets the rim.
    NUSSELT_HD Real place_of(const Vec3<Real>& wi) const noexcept {
        const Real aside = dot(wi, h_), up = max(wi.z, Real(0));
        const Real norm = detail::hypotenuse(aside, up);
        const Real inverse = detail::over_positive(Real(1), norm);
        const Real x = select(norm > Real(0), aside * inverse, Real(1)), y = up * inverse;
        const Vec3<Real> normal = x * basis_n_ - y * basis_h_;
        const Chord chord = chord_of(normal, x * basis_h_ + y * basis_n_);
        Real t = turn_sign_ * (angles_.angle_of(half_angle_at(chord.end)) - begin_);
        const Real full = Real(2) * half_range_;
        const Real wrapped = t + Real(2 * kPi<Scalar>);
        const auto wraps = is_inside_ & (t < Real(0)) & (wrapped - full < -t);
        t = select(wraps, wrapped, t);
        return min(max(detail::over_positive(t, half_range_) - Real(1), Real(-1)), Real(1));
    }

    /// The point of the disk of the cone at a share of the chord.
    NUSSELT_HD static Vec2<Real> towards(const Turn& turn, const Real& share) noexcept {
        return turn.near_end + share * (turn.far_end - turn.near_end);
    }

private:
    /// Where a plane through the pole cuts the rim.
    struct Chord {
        mask_t<Real> is_cut; ///< by the plane, which does more than touch it up to rounding
        mask_t<Real> is_met; ///< by the half-plane
        Vec2<Real> end;      ///< the end that is farther from the pole
        Real height;         ///< of the axis above the plane in the disk
        Real half;           ///< of the length of the chord
        Real steepness;      ///< height of a direction per height in the disk
    };

    /// \param normal of the plane, in the basis of the cone.
    /// \param out    in the half-plane and perpendicular to the pole, in the basis of the cone.
    NUSSELT_HD Chord chord_of(const Vec3<Real>& normal, const Vec3<Real>& out) const noexcept {
        Chord chord;
        const Real na = a_ * normal.x, nb = b_ * normal.y, nc = c_ * normal.z;
        const Real k = detail::hypotenuse(na, nb);
        const auto crosses = abs(nc) < k;
        // A plane that misses the rim has the point of it that is closest to the plane.
        const auto leans = k > Real(kTiny<Scalar>);
        chord.steepness = select(leans, k, Real(1));
        const Real inverse = Real(1) / chord.steepness;
        const Vec2<Real> up{select(leans, na * inverse, Real(1)), select(leans, nb * inverse, Real(0))};
        chord.height = min(max(nc * inverse, Real(-1)), Real(1));
        const auto gaps = detail::horizon_gaps({a_, b_, c_}, normal, chord.steepness);
        // Where a plane touches the rim at the pole, rounding would choose the side of the pole on which its end is.
        constexpr Scalar kTouching = std::numeric_limits<Scalar>::epsilon() / 4;
        chord.is_cut = crosses & (gaps.smaller > Real(kTouching));
        chord.half = sqrt(max(gaps.smaller * gaps.larger, Real(0)));
        const Vec2<Real> middle{-chord.height * up.x, -chord.height * up.y};
        const Vec2<Real> along{-chord.half * up.y, chord.half * up.x};
        const Vec2<Real> left = middle + along, right = middle - along;
        const Real to_left = select(is_inside_, component(left, out), dot(left, farthest_));
        const Real to_right = select(is_inside_, component(right, out), dot(right, farthest_));
        chord.end = select(to_left >= to_right, left, right);
        chord.is_met = chord.is_cut & (is_inside_ | (component(chord.end, out) > Real(0)));
        return chord;
    }

    /// The direction of a point of the disk, not of unit length, along an axis that is given in the basis of the cone.
    NUSSELT_HD Real component(const Vec2<Real>& disk, const Vec3<Real>& axis) const noexcept {
        return multiply_add(a_ * axis.x, disk.x, multiply_add(b_ * axis.y, disk.y, c_ * axis.z));
    }
    NUSSELT_HD Real length_of(const Vec2<Real>& disk) const noexcept {
        const Real x = a_ * disk.x, y = b_ * disk.y;
        return sqrt(multiply_add(x, x, multiply_add(y, y, c_ * c_)));
    }

    /// A vector of the disk from its coordinates along and across the direction to the farthest point.
    NUSSELT_HD Vec2<Real> from_farthest(const Vec2<Real>& v) const noexcept {
        return {farthest_.x * v.x - farthest_.y * v.y, farthest_.y * v.x + farthest_.x * v.y};
    }

    /// Half of the angle of the map of a point of the rim: a vector of any length.
    NUSSELT_HD SinCos<Real> half_angle_at(const Vec2<Real>& rim) const noexcept {
        return angles_.half_of(rim, farthest_.x * rim.y - farthest_.y * rim.x);
    }

    /// What a half-plane has of the cone, from its far end.
    /// \param far_cosine of the angle between the far end and the farthest point.
    NUSSELT_HD void add_chord(Turn& turn, const Real& far_cosine) const noexcept {
        const Vec2<Real>& rim = turn.far_end;
        // The other point of the rim on the line to the pole, or the pole if it is within.
        const Real far_sine = farthest_.x * rim.y - farthest_.y * rim.x;
        const Real t = tangent_cosine_;
        const Real sum = multiply_add(Real(2) * t, far_cosine, multiply_add(t, t, Real(1)));
        const Real factor =
            Real(2) * detail::over_positive(turn.volume, away_) / max(sum, Real(kTiny<Scalar>));
        const Vec2<Real> on_rim =
            from_farthest({factor * multiply_add(t, far_cosine, Real(1)), factor * t * far_sine});
        const Vec2<Real> chord = select(is_inside_, rim - inner_, on_rim);
        // The difference would lose the digits of a pole in the middle of a wide cone.
        turn.near_end = select(is_inside_, inner_, rim - chord);
        turn.far_length = length_of(rim);
        turn.near_length = length_of(turn.near_end);

        // The angle between both ends: no term of the cross product cancels.
        const Vec3<Real> normal{(b_ * c_) * chord.y, (a_ * c_) * chord.x,
                                (a_ * b_) * (rim.x * chord.y - rim.y * chord.x)};
        const Vec2<Real>& near_end = turn.near_end;
        const Real scalar = (a_ * rim.x) * (a_ * near_end.x) + (b_ * rim.y) * (b_ * near_end.y) + c_ * c_;
        turn.angle = atan2_positive(length(normal), scalar);
        const auto half = sincos_half_turn(Real(0.5) * turn.angle);
        turn.half_sine = half.sin;
        turn.half_cosine = half.cos;

        const Real aside = component(rim, basis_h_);
        turn.across = detail::hypotenuse(aside, turn.clearance);
        const Real inverse = detail::over_positive(Real(1), turn.across);
        turn.away = {select(turn.across > Real(0), aside * inverse, Real(1)), turn.clearance * inverse};
        turn.gamma = atan2_positive(turn.across, component(rim, basis_p_));
        turn.near_gamma = select(is_inside_, Real(0), max(turn.gamma - turn.angle, Real(0)));
    }

    Real a_, b_, c_;
    Vec3<Real> pole_, h_;
    Real turn_sign_;    ///< of angles in the disk as half-planes turn up from the first horizon
    Real pole_scale_;   ///< by which the next two are divided
    Real away_, level_; ///< the pole as a homogeneous point of the disk: distance from the centre, weight
    mask_t<Real> is_inside_; ///< whether the pole is in the cone
    Vec2<Real> farthest_;    ///< the point of the rim opposite to the pole
    Vec2<Real> inner_;       ///< the pole in the disk
    Real tangent_cosine_; ///< of the angle between the pole and the points at which half-planes touch the rim
    Vec3<Real> basis_h_, basis_p_, basis_n_; ///< h, pole and normal in the basis of the cone
    mask_t<Real> is_clipped_, is_lit_;
    RimAngles<Real> angles_;         ///< from the farthest point
    mask_t<Real> starts_at_horizon_; ///< else where the first half-plane touches the rim
    Vec2<Real> start_;
    Real level_cosine_,
        level_sine_; ///< of half of the arc that the first horizon, or the polar line of the pole, cuts off
    Real horizon_;   ///< height above the first horizon per height in the disk
    Real begin_, half_range_;        ///< angles of the map
    Real start_sine_, start_cosine_; ///< of half of begin_
    Real start_scale_, start_squeezed_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.a_, self.b_, self.c_, self.pole_, self.h_, self.turn_sign_, self.pole_scale_, self.away_,
              self.level_, self.is_inside_, self.farthest_, self.inner_, self.tangent_cosine_, self.basis_h_,
              self.basis_p_, self.basis_n_, self.is_clipped_, self.is_lit_, self.angles_,
              self.starts_at_horizon_, self.start_, self.level_cosine_, self.level_sine_, self.horizon_,
              self.begin_, self.half_range_, self.start_sine_, self.start_cosine_, self.start_scale_,
              self.start_squeezed_);
    }
};

NUSSELT_NAMESPACE_END
