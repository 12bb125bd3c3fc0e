#pragma once
/// Sampling of the part of an elliptic cone above a horizon that cuts it, in proportion to the cosine at the surface.
///
/// Derived here. A ray sweeps around a pole p on the horizon, in the middle of the horizon's arc in the cone. At an
/// angle gamma from the pole the cosine times the solid angle is sin^2(gamma) dgamma times the measure of the sweep, so
/// that gamma follows the inverse cycloid, up to the angle of the rim. The sweep is described by the point of the rim R
/// that it meets:
///
///     measure = E(gamma) (n . R) (p . R x dR),  E = (2 gamma - sin(2 gamma)) / (4 sin^3(gamma)).
///
/// This has no root-like ends and no cases, and tends to a trigonometric polynomial of degree two for small lights. Two
/// maps of the rim keep it smooth for large ones: the tangents of angles around the axis are scaled by (b1 / a1)^(3/4),
/// half-way between the disk of the cone and the ellipse that is its projection along the axis, and those of
/// half-angles from the point opposite to the pole, or the highest one if the axis is below the horizon, by
/// 1 / cos(gamma / 2) there, because rays that almost reach the antipode of the pole turn quickly. 16 places of the
/// result give its distribution up to rounding for ordinary lights, 64 for nearly all that are close to the point or
/// much longer than wide (docs/techniques/elliptic_cone.md).

#include <nusselt/cones/cone_parts.h>
#include <nusselt/cones/rim_distribution.h>
#include <nusselt/cones/rim_map.h>

NUSSELT_NAMESPACE_BEGIN

/// A direction in an elliptic cone.
template <class Real>
struct ConeSample {
    Vec3<Real> wi;   ///< unit
    Vec2<Real> disk; ///< the point of the disk of the cone
};

namespace detail {

/// The measure of the sweep per z.
struct CosineSweepDensity {
    template <class Real>
    NUSSELT_HD static Real density_at(const RimMap<Real>& map, const Real& z) noexcept {
        return map.density(map.turned(z));
    }
};

} // namespace detail

/// \tparam Real float, double, long double or a pack.
///
/// The horizon is z = 0. Valid for cones that the horizon cuts; others give a measure of 0 or any density.
/// \tparam Places of the rim, kConePlaces or kFineConePlaces.
template <class Real, int Places>
class ConeSweep {
public:
    ConeSweep() = default;

    /// \param cone with a visible part above the horizon.
    NUSSELT_HD explicit ConeSweep(const EllipticCone<Real>& cone) noexcept : map_(cone) {
        rim_ = RimDistribution<Real, Places>(detail::densities_at_nodes<detail::CosineSweepDensity>(map_));
        measure_ = cone_measure(rim_.integral() * map_.scale(), map_.is_lit(cone));
    }

    template <class Single>
    NUSSELT_HD explicit ConeSweep(const ConeSweep<Single, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the pole, u.y leads away from it.
    NUSSELT_HD ConeSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto turn = map_.turned(rim_.invert(u.x));
        const auto& rim = turn.rim;
        const auto angle = map_.angle_of(rim);
        const Real fraction = cycloid_fraction(angle.value, angle.sine, angle.cosine);
        const Real gamma = inverse_cycloid(u.y, angle.value, fraction);
        const auto s = sincos_half_turn(gamma);
        const auto rest = sincos_half_turn(max(angle.value - gamma, Real(0)));

        // The direction in the plane of pole and rim, of which the normal keeps its height.
        const Vec3<Real> away = normalize(Vec3<Real>{rim.aside, rim.up, Real(0)});
        Vec3<Real> wi = s.cos * map_.p() + (s.sin * away.x) * map_.h();
        wi.z = s.sin * away.y;
        // The rim is the end of the way from the pole to it.
        const Real near = map_.distance() * s.sin;
        const Real share =
            min(detail::over_positive(near, multiply_add(rim.length, rest.sin, near)), Real(1));
        return {wi, map_.towards(rim, share)};
    }

    /// The density of a unit direction in the cone over its cosine [1/sr].
    NUSSELT_HD Real density_per_cosine(const Vec3<Real>& wi) const noexcept {
        if (all(rim_.is_exact())) return measure_.inverse;
        const auto turn = map_.turned(map_.place_of(wi));
        const Real ratio = detail::over_positive(rim_.value(turn.z), map_.density(turn));
        return select(rim_.is_exact(), Real(1), ratio) * measure_.inverse;
    }

    /// The random numbers for which sample() returns a unit direction in the cone.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const auto turn = map_.turned(map_.place_of(wi));
        const auto angle = map_.angle_of(turn.rim);
        const Real across = detail::hypotenuse(dot(wi, map_.h()), wi.z), along = dot(wi, map_.p());
        const Real gamma = min(atan2_positive(across, along), angle.value);
        const Real share = detail::over_positive(gamma, angle.value);
        const Real inner = cycloid_fraction(gamma, across, along);
        const Real outer = cycloid_fraction(angle.value, angle.sine, angle.cosine);
        const Real integral = rim_.integral();
        return {below_one(detail::over_positive(rim_.below(turn.z), integral)),
                below_one(share * share * share * (inner / outer))};
    }

    /// Projected solid angle of the part above the horizon [sr].
    NUSSELT_HD Real measure() const noexcept { return measure_.value; }

private:
    RimMap<Real> map_;
    RimDistribution<Real, Places> rim_;
    ConeMeasure<Real> measure_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.map_, self.rim_, self.measure_);
    }
};

NUSSELT_NAMESPACE_END
