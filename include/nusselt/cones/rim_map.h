#pragma once
/// The rim of an elliptic cone that a horizon cuts, as a function of z in [-1, 1] for which the measure of a sweep is
/// smooth. See cone_sweep.h and solid_sweep.h.

#include <limits>

#include <nusselt/cones/cycloid.h>
#include <nusselt/cones/elliptic_cone.h>
#include <nusselt/cones/horizon_gaps.h>
#include <nusselt/cones/rim_angles.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack.
///
/// The horizon is z = 0. Lanes whose cone it does not cut have is_lit() false and any numbers.
template <class Real>
class RimMap {
    using Scalar = scalar_t<Real>;

public:
    /// A point of the rim. Its direction is not of unit length.
    struct Rim {
        Vec2<Real> disk;       ///< across and up from the axis
        Real length;           ///< of the direction
        Real along, aside, up; ///< the direction in the basis p, h, n
    };
    struct Angle {
        Real value, sine, cosine;
    };
    /// A point of the rim as a function of z in [-1, 1].
    struct Turn {
        Real z;
        Rim rim;
        Real clearance; ///< height above the horizon in the disk
        Real jacobian;  ///< angle in the disk per angle of the map
    };

    RimMap() = default;

    NUSSELT_HD explicit RimMap(const EllipticCone<Real>& cone) noexcept {
        a_ = cone.a;
        b_ = cone.b;

        // Find the horizon in the disk, n_1 a s + n_2 b t + n_3 c = 0, as the height along e_n, which leads up.
        const Vec3<Real> height = detail::heights_of_axes(cone);
        const Real na = height.x * a_, nb = height.y * b_;
        const Real k = detail::hypotenuse(na, nb);
        const auto leans = k >= Real(std::numeric_limits<Scalar>::min());
        const auto wide = min(a_, b_) > Real(kTiny<Scalar>);
        const auto rises = leans & wide;
        const Real inverse = Real(1) / select(rises, k, Real(1));
        up_ = {select(rises, na * inverse, Real(1)), select(rises, nb * inverse, Real(0))};
        // Half-spaces count as cones with large angles, so that heights of points of the rim have digits left. If the
        // rim is all but a line, points at both of its ends have digits left, too. The bound is less than any height
        // that counts, whatever rounding does: each half-space is above the horizon, cut by it or below it.
        constexpr Scalar kRounding = Scalar(0.999f) * detail::kConeRounding<Real>;
        const Real extent_up = detail::hypotenuse(a_ * up_.x, b_ * up_.y);
        c_ = max(cone.c, max(Real(kRounding) * extent_up, Real(kRounding) - min(a_, b_)));
        const Real nc = height.z * c_;
        is_cut_ = rises & (abs(nc) < k);
        slope_ = select(is_cut_, k, Real(1));
        const Real inverse_k = select(is_cut_, inverse, Real(1));
        const auto gaps = detail::horizon_gaps({a_, b_, c_}, height, slope_);
        const auto sinks = nc < Real(0);
        const Real lower = select(sinks, gaps.larger, gaps.smaller); // 1 - h0
        const Real upper = select(sinks, gaps.smaller, gaps.larger); // 1 + h0
        height_ = nc * inverse_k;
        gap_ = gaps.smaller;
        const Real half_arc = sqrt(max(lower * upper, Real(0)));
        squared_tangent_ = upper / max(lower, Real(std::numeric_limits<Scalar>::epsilon() / 16));

        // Find the pole, where the bisector of both ends of the horizon's arc meets it.
        const Vec3<Real> across{-a_ * up_.y, b_ * up_.x, Real(0)};
        const Vec3<Real> upwards{a_ * up_.x, b_ * up_.y, Real(0)};
        const Vec3<Real> middle{-height_ * upwards.x, -height_ * upwards.y, c_};
        const Real to_ends = length(middle + half_arc * across) + length(middle - half_arc * across);
        const Real relative = half_arc / select(to_ends > Real(0), to_ends, Real(1));
        const Real skew = (Real(4) * relative * relative) * (((a_ - b_) * (a_ + b_)) * (up_.x * up_.y));
        pole_ = -skew * height_;
        power_ = max((half_arc - pole_) * (half_arc + pole_), Real(0));
        const Vec3<Real> q = middle + pole_ * across;
        distance_ = length(q);
        const Real inverse_distance = detail::over_positive(Real(1), distance_);
        const Vec3<Real> p = inverse_distance * q;

        // Express directions of the disk in the basis of the horizontal h and the normal.
        const Vec3<Real> in_world = p.x * cone.e1 + p.y * cone.e2 + p.z * cone.e3;
        p_ = normalize(Vec3<Real>{in_world.x, in_world.y, Real(0)});
        const Vec3<Real> aside{-p_.y, p_.x, Real(0)};
        const Vec3<Real> h{dot(aside, cone.e1), dot(aside, cone.e2), dot(aside, cone.e3)};
        const Real sign = select(dot(h, across) < Real(0), Real(-1), Real(1));
        h_ = sign * aside;
        shear_ = sign * dot(h, upwards);
        narrowing_ = (c_ * inverse_distance) * (a_ * b_ * inverse_k);
        along_across_ = dot(p, across);
        along_up_ = dot(p, upwards);

        // Choose the map of the rim.
        // The ray to the point opposite to the pole is the one that almost reaches the antipode, if any does. Of small
        // parts above the horizon, the highest point is as good, and heights above the horizon have all their digits.
        const Real lean = select(height_ > Real(0), skew, Real(0));
        const Real inverse_lean = Real(1) / sqrt(multiply_add(lean, lean, Real(1)));
        reference_ = {lean * inverse_lean, inverse_lean};
        angles_ = RimAngles<Real>(a_, b_, c_, from_up(reference_));
        const Rim top = rim_at(reference_, select(height_ > Real(0), reference_.y + height_, upper));
        const Real versine =
            detail::versine(detail::hypotenuse(top.aside, top.up) / top.length, -top.along / top.length);
        angles_.set_stretch(max(Real(0.5) * versine, Real(kTiny<Scalar>)));
        // Of a rim that is all but above the horizon, both ends are at half a turn, on either side.
        left_ = -abs(angle_at({-half_arc, -height_}));
        const Real right = abs(angle_at({half_arc, -height_}));
        half_range_ = Real(0.5) * (right - left_);
    }

    template <class Single>
    NUSSELT_HD explicit RimMap(const RimMap<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// Whether the horizon cuts the cone, and the cone has an extent.
    NUSSELT_HD mask_t<Real> is_lit(const EllipticCone<Real>& cone) const noexcept {
        return is_cut_ & cone.is_visible;
    }
    /// Unit and horizontal: to the pole, and perpendicular to it.
    NUSSELT_HD const Vec3<Real>& p() const noexcept { return p_; }
    NUSSELT_HD const Vec3<Real>& h() const noexcept { return h_; }
    /// Of the pole from the origin, as a point of the cone.
    NUSSELT_HD const Real& distance() const noexcept { return distance_; }
    /// The measure of the sweep over the integral of density() over z.
    NUSSELT_HD Real scale() const noexcept { return narrowing_ * slope_ * slope_ * half_range_; }

    /// The point of the disk of the cone on the way from the pole to a point of the rim.
    NUSSELT_HD Vec2<Real> towards(const Rim& rim, const Real& share) const noexcept {
        const Vec2<Real> from{pole_, -height_};
        const Vec2<Real> disk = from + share * (rim.disk - from);
        return from_up(disk);
    }

    NUSSELT_HD static Angle angle_of(const Rim& rim) noexcept {
        const Real inverse = Real(1) / rim.length;
        const Real sine = detail::hypotenuse(rim.aside, rim.up) * inverse;
        const Real cosine = rim.along * inverse;
        return {atan2_positive(sine, cosine), sine, cosine};
    }

    /// \param z in [-1, 1]
    NUSSELT_HD Turn turned(const Real& z) const noexcept {
        const Real zeta = multiply_add(half_range_, z + Real(1), left_);
        const auto half = sincos_quarter_turn_with_sign(Real(0.5) * zeta);
        const auto point = angles_.at(angles_.stretch * half.cos, half.sin);
        const Real cosine = point.inverse_length * dot(point.scaled, from_up(reference_));
        const Real across = multiply_add(point.across, reference_.y, cosine * reference_.x);
        const Real up = multiply_add(cosine, reference_.y, -point.across * reference_.x);

        // The height above the horizon, by the squares of the tangents of half-angles: nothing cancels but at the ends.
        const auto below = up < Real(0);
        const Real positive = max(abs(across), Real(std::numeric_limits<Scalar>::epsilon()));
        const Real t = select(below, Real(1) - up, across) / select(below, positive, Real(1) + up);
        const Real s = min(t * t, squared_tangent_);
        const Real clearance =
            Real(2) * (squared_tangent_ - s) / ((Real(1) + s) * (Real(1) + squared_tangent_));

        Turn result;
        result.z = z;
        result.rim = rim_at({across, up}, clearance);
        result.clearance = clearance;
        result.jacobian = point.jacobian;
        return result;
    }

    /// The measure of the sweep per z, up to a constant.
    NUSSELT_HD Real density(const Turn& turn) const noexcept {
        const Rim& rim = turn.rim;
        const Angle angle = angle_of(rim);
        const CycloidRatio<Real> ratio = cycloid_ratio(angle.value, angle.sine, angle.cosine);
        const Real cosine = select(ratio.is_small, angle.cosine, Real(1));
        const Real weight = Real(0.25) * ratio.value / (cosine * cosine * cosine);
        // 1 + height y - pole x, where the first two terms may cancel.
        const Real rise = abs(rim.disk.y);
        const Real across = (rim.disk.x / (Real(1) + rise) - pole_) * rim.disk.x;
        const Real apart = multiply_add(-pole_, rim.disk.x, multiply_add(height_, rim.disk.y, Real(1)));
        const Real close = multiply_add(gap_, rise, across);
        const Real volume = max(select(height_ * rim.disk.y < Real(0), close, apart), Real(0));
        const Real inverse = Real(1) / rim.length;
        return weight * turn.clearance * volume * (inverse * inverse * inverse) * turn.jacobian;
    }

    /// The solid angle of the sweep per z, up to a constant. It is positive at both ends as well.
    NUSSELT_HD Real solid_density(const Turn& turn) const noexcept {
        const Rim& rim = turn.rim;
        // 1 + h0 y - pole x as a sum of squares: nothing cancels for the last sliver above the horizon.
        const Real offset = rim.disk.x - pole_;
        const Real volume =
            Real(0.5) * multiply_add(offset, offset, multiply_add(turn.clearance, turn.clearance, power_));
        // The length of the ray plus its part along the pole, from the square of its sine where they cancel.
        const auto back = rim.along < Real(0);
        const Real squared = multiply_add(rim.aside, rim.aside, rim.up * rim.up);
        const Real sum =
            select(back, squared, rim.length + rim.along) / select(back, rim.length - rim.along, Real(1));
        // Quotients must stay finite.
        constexpr Scalar kRounding = std::numeric_limits<Scalar>::epsilon();
        const Real least = Real(kRounding * kRounding) * rim.length;
        return volume * turn.jacobian / (rim.length * max(sum, least));
    }
    /// The solid angle of the sweep over the integral of solid_density() over z.
    NUSSELT_HD Real solid_scale() const noexcept { return narrowing_ * slope_ * half_range_; }

    /// 1 minus the cosine of the angle of a point of the rim from the pole.
    NUSSELT_HD static Real versine_of(const Rim& rim) noexcept {
        // Next to the antipode, rounding may take the cosine below -1: by a percent where the point is on the rim.
        const Real cosine = min(max(rim.along / rim.length, Real(-1)), Real(1));
        return detail::versine(detail::hypotenuse(rim.aside, rim.up) / rim.length, cosine);
    }

    /// The place z in [-1, 1] at which the ray from the pole through a direction meets the rim.
    NUSSELT_HD Real place_of(const Vec3<Real>& wi) const noexcept {
        // The ray in the disk, scaled to order one.
        const Real up = max(wi.z, Real(0)), aside = dot(wi, h_);
        Vec2<Real> ray{aside - (shear_ / slope_) * up, (narrowing_ / slope_) * up};
        const Real extent = max(abs(ray.x), ray.y);
        const Real scale = reciprocal_power_of_two(extent);
        ray = scale * ray;
        const Real squared = dot(ray, ray);
        const auto meets = squared > Real(0);
        ray = select(meets, ray, Vec2<Real>{Real(0), Real(1)});
        const Real safe = select(meets, squared, Real(1));

        // The larger root of the distance to the rim, in the form without cancellation.
        const Real half = multiply_add(pole_, ray.x, -height_ * ray.y);
        const Real root = sqrt(max(multiply_add(half, half, safe * power_), Real(0)));
        const auto inwards = half <= Real(0);
        const Real reach =
            select(inwards, (root - half) / safe, power_ / select(inwards, Real(1), half + root));
        const Vec2<Real> point{multiply_add(reach, ray.x, pole_), multiply_add(reach, ray.y, -height_)};

        const Real zeta = angle_at(point);
        const Real z = detail::over_positive(zeta - left_, half_range_) - Real(1);
        return min(max(z, Real(-1)), Real(1));
    }

private:
    /// A point of the disk, given across and up from the axis.
    NUSSELT_HD Vec2<Real> from_up(const Vec2<Real>& p) const noexcept {
        return {p.y * up_.x - p.x * up_.y, p.y * up_.y + p.x * up_.x};
    }

    /// \param disk      a point of the unit circle, across and up from the axis.
    /// \param clearance its height above the horizon.
    NUSSELT_HD Rim rim_at(const Vec2<Real>& disk, const Real& clearance) const noexcept {
        const Real s = a_ * (disk.y * up_.x - disk.x * up_.y);
        const Real t = b_ * (disk.y * up_.y + disk.x * up_.x);
        const Real offset = disk.x - pole_;
        const Real along = multiply_add(along_across_, offset, multiply_add(along_up_, clearance, distance_));
        return {disk, sqrt(multiply_add(s, s, multiply_add(t, t, c_ * c_))), along,
                multiply_add(narrowing_, offset, shear_ * clearance), slope_ * clearance};
    }

    /// The angle of the map of a point of the rim, given across and up from the axis.
    NUSSELT_HD Real angle_at(const Vec2<Real>& point) const noexcept {
        const Real cross = multiply_add(point.x, reference_.y, -point.y * reference_.x);
        return angles_.angle_of(angles_.half_of(from_up(point), cross));
    }

    NUSSELT_HD static SinCos<Real> sincos_quarter_turn_with_sign(const Real& angle) noexcept {
        const auto s = sincos_half_turn(abs(angle));
        return {copysign(s.sin, angle), max(s.cos, Real(0))};
    }

    Real a_, b_, c_;
    Vec2<Real> up_;        ///< in the disk, away from the horizon
    Real height_;          ///< of the axis above the horizon in the disk
    Real gap_;             ///< 1 minus its magnitude, accurate relative to itself
    Real squared_tangent_; ///< of a quarter of the angle of the arc above the horizon
    Real pole_;            ///< across
    Real power_;           ///< of the pole: 1 minus its squared distance from the axis
    Real distance_;        ///< of the pole, as a point of the cone
    Vec3<Real> p_, h_;     ///< unit and horizontal: to the pole, and perpendicular to it
    Real shear_, narrowing_, slope_, along_across_, along_up_; ///< from the disk to p, h and n
    Vec2<Real> reference_;   ///< of angles: the highest point, or the one opposite to the pole; across and up
    RimAngles<Real> angles_; ///< from the reference
    Real left_, half_range_; ///< angles of the map
    mask_t<Real> is_cut_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.a_, self.b_, self.c_, self.up_, self.height_, self.gap_, self.squared_tangent_, self.pole_,
              self.power_, self.distance_, self.p_, self.h_, self.shear_, self.narrowing_, self.slope_,
              self.along_across_, self.along_up_, self.reference_, self.angles_, self.left_, self.half_range_,
              self.is_cut_);
    }
};

NUSSELT_NAMESPACE_END
