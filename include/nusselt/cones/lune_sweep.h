#pragma once
/// Sampling of the part of an elliptic cone between two horizons, in proportion to the cosine at the first one.
///
/// Derived here. Both horizons meet in a line through the origin, the axis. Half-planes that end at the axis turn from
/// the first horizon to the second one; each meets the cone between two angles from the pole, one of the two directions
/// of the axis. With the angle gamma from the pole, the cosine times the solid angle is sin^2(gamma) dgamma times the
/// measure of the sweep, as in cone_sweep.h, so that gamma follows the inverse cycloid between both angles. The sweep
/// is described by the point R of the rim that is farther from the pole; the other one is a rational function of it:
///
///     measure = (I / sin^3(gamma)) (n . R) (p . R x dR),  I the integral of sin^2 between both angles.
///
/// There are no pieces: the part between both horizons has one arc of the rim of far points, from the first horizon, or
/// the tangent half-plane if the first horizon misses the cone, to the second one. The density is smooth in it, and
/// does not change if the pole enters the cone. It vanishes at the first horizon and not at the second one; with
/// z = 1 - (1 - w)^2 / 2 it has the zero in w that rim_distribution.h expects.

#include <nusselt/cones/cone_parts.h>
#include <nusselt/cones/cone_sweep.h>
#include <nusselt/cones/lune_map.h>
#include <nusselt/cones/rim_distribution.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// A change of variable from w to z, with which the density vanishes at the second horizon, too.
struct LuneChange {
    template <class Real>
    NUSSELT_HD static Real stretched(const Real& w) noexcept {
        const Real rest = Real(1) - w;
        return Real(1) - Real(0.5) * rest * rest;
    }
    /// Keeps away from the end, where densities are quotients of numbers that vanish.
    template <class Real>
    NUSSELT_HD static Real squeezed(const Real& z) noexcept {
        const Real w = Real(1) - sqrt(max(Real(2) * (Real(1) - z), Real(0)));
        return min(w, Real(1 - 4 * std::numeric_limits<scalar_t<Real>>::epsilon()));
    }
    template <class Real>
    NUSSELT_HD static Real density_at(const LuneMap<Real>& map, const Real& w) noexcept {
        return (Real(1) - w) * map.density(map.turned(stretched(w)));
    }
};

} // namespace detail

/// \tparam Real float, double, long double or a pack.
///
/// The first horizon is z = 0, the second one a plane through the y-axis. Valid where is_clipped(); else it has any
/// density.
/// \tparam Places of the rim, kConePlaces or kFineConePlaces.
template <class Real, int Places>
class LuneSweep {
    using Scalar = scalar_t<Real>;
    using Change = detail::LuneChange;

public:
    LuneSweep() = default;

    /// \param is_visible whether the cone is that of a light with an extent.
    NUSSELT_HD LuneSweep(const LuneMap<Real>& map, const mask_t<Real>& is_visible) noexcept : map_(map) {
        rim_ = RimDistribution<Real, Places>(detail::densities_at_nodes<Change>(map_));
        measure_ = cone_measure(rim_.integral() * map_.scale(), mask_t<Real>(map_.is_clipped() & is_visible));
    }

    template <class Single>
    NUSSELT_HD explicit LuneSweep(const LuneSweep<Single, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, u.y leads away from the pole. Continuous in both.
    NUSSELT_HD ConeSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto turn = map_.turned(Change::stretched(rim_.invert(u.x)));
        const Real angle = angle_at(turn, u.y);
        const auto s = sincos_half_turn(turn.near_gamma + angle);
        Vec3<Real> wi = s.cos * map_.pole() + (s.sin * turn.away.x) * map_.h();
        wi.z = s.sin * turn.away.y;
        const Real near = turn.near_length * sincos_half_turn(angle).sin;
        const Real rest = turn.far_length * sincos_half_turn(max(turn.angle - angle, Real(0))).sin;
        return {wi, map_.towards(turn, min(detail::over_positive(near, near + rest), Real(1)))};
    }

    /// The density of a unit direction in the cone over its cosine [1/sr].
    NUSSELT_HD Real density_per_cosine(const Vec3<Real>& wi) const noexcept {
        if (all(rim_.is_exact())) return measure_.inverse;
        const Real w = Change::squeezed(map_.place_of(wi));
        const Real ratio = detail::over_positive(rim_.value(w), Change::density_at(map_, w));
        return select(rim_.is_exact(), Real(1), ratio) * measure_.inverse;
    }

    /// The random numbers for which sample() returns a unit direction in the cone.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const auto turn = map_.turned(map_.place_of(wi));
        const Real across = detail::hypotenuse(dot(wi, map_.h()), wi.z);
        const Real gamma = atan2_positive(across, dot(wi, map_.pole()));
        const Real angle = min(max(gamma - turn.near_gamma, Real(0)), turn.angle);
        const auto half = sincos_half_turn(Real(0.5) * angle);
        const Real below = rim_.below(Change::squeezed(turn.z));
        return {below_one(detail::over_positive(below, rim_.integral())),
                below_one(
                    detail::over_positive(map_.measure_up_to(turn, angle, half.sin, half.cos), whole(turn)))};
    }

    /// Projected solid angle of the part between both horizons [sr].
    NUSSELT_HD const Real& measure() const noexcept { return measure_.value; }

private:
    using Turn = typename LuneMap<Real>::Turn;

    NUSSELT_HD Real whole(const Turn& turn) const noexcept {
        return map_.measure_up_to(turn, turn.angle, turn.half_sine, turn.half_cosine);
    }

    /// The angle from the near end below which a share of the measure of a half-plane is.
    NUSSELT_HD Real angle_at(const Turn& turn, const Real& share) const noexcept {
        const Real total = whole(turn);
        // From the pole, the angle is that of the inverse cycloid. For half-planes that meet the cone far from the
        // pole, its digits do not suffice.
        const auto far_end = sincos_half_turn(turn.gamma);
        const Real fraction = cycloid_fraction(turn.gamma, far_end.sin, far_end.cos);
        const Real lever = turn.gamma * detail::over_positive(Real(1), turn.across);
        const Real from_pole = Real(Scalar(1) / 3) * fraction * (lever * lever * lever);
        const Real outer = (Real(1) - share) * detail::over_positive(total, from_pole);
        const Real start = inverse_cycloid(min(max(Real(1) - outer, Real(0)), Real(1)), turn.gamma, fraction);
        Real angle = min(max(start - turn.near_gamma, Real(0)), turn.angle);
        const Real goal = share * total;
        NUSSELT_UNROLL
        for (int i = 0; i < kSteps; ++i) {
            const auto half = sincos_half_turn(Real(0.5) * angle);
            const Real sine = sincos_half_turn(turn.near_gamma + angle).sin;
            const Real inverse = detail::over_positive(Real(1), turn.across);
            const Real slope = sine * inverse * (sine * inverse) * inverse;
            const Real step =
                detail::over_positive(map_.measure_up_to(turn, angle, half.sin, half.cos) - goal, slope);
            angle = min(max(angle - step, Real(0)), turn.angle);
        }
        return angle;
    }

    static constexpr int kSteps = kIsSingle<Real> ? 1 : 2;

    LuneMap<Real> map_;
    RimDistribution<Real, Places> rim_;
    ConeMeasure<Real> measure_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.map_, self.rim_, self.measure_);
    }
};

NUSSELT_NAMESPACE_END
