#pragma once
/// Sampling of the part of an elliptic cone above a horizon that cuts it, by solid angle.
///
/// Derived here. A ray sweeps around the pole p of cone_sweep.h, which is on the horizon. The cosine of the angle gamma
/// from the pole is uniform from 1 to that of the rim, and the sweep has the measure
///
///     measure = (p . R x dR) / (|R| (|R| + p . R))
///
/// with the point of the rim R that it meets. Unlike that of the cosine, it does not vanish at the ends of the
/// horizon's arc. With z = w (3 - w^2) / 2 it has the factor 1 - w^2 in w, and so the polynomial of rim_distribution.h.

#include <limits>

#include <nusselt/cones/cone_parts.h>
#include <nusselt/cones/cone_sweep.h>
#include <nusselt/cones/rim_distribution.h>
#include <nusselt/cones/rim_map.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// A change of the variable, from w to z: a density that does not vanish at both ends has the factor 1 - w^2 in w.
struct SolidSweepChange {
    /// \param w in [-1, 1]
    template <class Real>
    NUSSELT_HD static Real stretched(const Real& w) noexcept {
        return Real(0.5) * w * multiply_add(-w, w, Real(3));
    }
    /// The derivative of stretched().
    template <class Real>
    NUSSELT_HD static Real slope(const Real& w) noexcept {
        return Real(1.5) * ((Real(1) - w) * (Real(1) + w));
    }
    /// The inverse of stretched(): the root of a cubic, by a third of an angle. It keeps away from the ends, where
    /// densities are quotients of numbers that vanish.
    template <class Real>
    NUSSELT_HD static Real squeezed(const Real& z) noexcept {
        using Scalar = scalar_t<Real>;
        const Real angle = atan2_positive(abs(z), sqrt(max((Real(1) - z) * (Real(1) + z), Real(0))));
        const Real w = Real(2) * sincos_quarter_turn(Real(Scalar(1) / 3) * angle).sin;
        return copysign(min(w, Real(1 - 4 * std::numeric_limits<Scalar>::epsilon())), z);
    }
    /// The measure of the sweep per w.
    template <class Real>
    NUSSELT_HD static Real density_at(const RimMap<Real>& map, const Real& w) noexcept {
        return slope(w) * map.solid_density(map.turned(stretched(w)));
    }
};

} // namespace detail

/// \tparam Real float, double, long double or a pack.
///
/// The horizon is z = 0. Valid for cones that the horizon cuts; others give a measure of 0 or any density.
/// \tparam Places of the rim, kConePlaces or kFineConePlaces.
template <class Real, int Places>
class SolidSweep {
    using Change = detail::SolidSweepChange;

public:
    SolidSweep() = default;

    /// \param cone with a visible part above the horizon.
    NUSSELT_HD explicit SolidSweep(const EllipticCone<Real>& cone) noexcept : map_(cone) {
        rim_ = RimDistribution<Real, Places>(detail::densities_at_nodes<Change>(map_));
        measure_ = cone_measure(rim_.integral() * map_.solid_scale(), map_.is_lit(cone));
    }

    template <class Single>
    NUSSELT_HD explicit SolidSweep(const SolidSweep<Single, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the pole, u.y leads away from it. Continuous in both.
    NUSSELT_HD ConeSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto turn = map_.turned(Change::stretched(rim_.invert(u.x)));
        const auto& rim = turn.rim;
        const Real versine = u.y * map_.versine_of(rim);
        const Real cosine = Real(1) - versine;
        const Real sine = sqrt(max(versine * (Real(2) - versine), Real(0)));

        // The direction in the plane of pole and rim, of which the normal keeps its height.
        const Vec3<Real> away = normalize(Vec3<Real>{rim.aside, rim.up, Real(0)});
        Vec3<Real> wi = cosine * map_.p() + (sine * away.x) * map_.h();
        wi.z = sine * away.y;
        // The rim is the end of the way from the pole to it.
        const Real near = map_.distance() * sine;
        const Real across = detail::hypotenuse(rim.aside, rim.up);
        const Real rest = max(across * cosine - rim.along * sine, Real(0));
        const Real share = min(detail::over_positive(near, rest + near), Real(1));
        return {wi, map_.towards(rim, share)};
    }

    /// The density of a unit direction in the cone [1/sr].
    NUSSELT_HD Real density(const Vec3<Real>& wi) const noexcept {
        if (all(rim_.is_exact())) return measure_.inverse;
        const auto turn = map_.turned(map_.place_of(wi));
        const Real w = Change::squeezed(turn.z);
        const Real ratio = detail::over_positive(rim_.value(w), Change::slope(w) * map_.solid_density(turn));
        return select(rim_.is_exact(), Real(1), ratio) * measure_.inverse;
    }

    /// The random numbers for which sample() returns a unit direction in the cone.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const auto turn = map_.turned(map_.place_of(wi));
        const Real across = detail::hypotenuse(dot(wi, map_.h()), wi.z), along = dot(wi, map_.p());
        const Real below = rim_.below(Change::squeezed(turn.z));
        return {below_one(detail::over_positive(below, rim_.integral())),
                below_one(detail::over_positive(detail::versine(across, along), map_.versine_of(turn.rim)))};
    }

    /// Solid angle of the part above the horizon [sr].
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
