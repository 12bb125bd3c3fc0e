#pragma once
/// A published method, to compare with: a stratified map from the square to projected spherical caps.
///
/// C. Ureña, I. Georgiev 2018, Stratified Sampling of Projected Spherical Caps, CGF 37(4), doi:10.1111/cgf.13471, the parallel map:
/// the projection to the surface is an ellipse, or an ellipse with a lune of the unit disk; it is cut into lines towards the light.
/// The area on one side of a line is known in closed form, and inverted by Newton's method within a bracket; along the line, points
/// are uniform.
///
/// Deviations: the bracket is halved where Newton's method leaves it, with a fixed number of steps.
/// Known failures: differences of numbers of order one lose the digits of small lights that the horizon cuts.

#include <nusselt/core/light_sample.h>
#include <nusselt/related/projected_cap.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or many samples
///              of one light (see the broadcasting constructor).
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], wi.z / measure().
/// Space: shading space; clips to the horizon by itself.
/// Edge cases: no radius, nothing above the horizon, the origin inside: pdf = 0, measure 0.
template <class Real>
class SphereProjectedSolidAngleUrena {
    using Scalar = scalar_t<Real>;
    static constexpr int kSteps = kIsSingle<Real> ? 10 : 30;

public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit SphereProjectedSolidAngleUrena(const Sphere<Real>& light) noexcept : cap_(light) {
        edge_ = sqrt(max((Real(1) - cap_.cut) * (Real(1) + cap_.cut), Real(0)));
        const auto rises = cap_.axis.y > Real(0);
        end_ = select(rises, cap_.sine, edge_);
        at_edge_ = lune_below(edge_);
        ellipse_at_edge_ = ellipse_below(edge_);
        half_ = below(end_);
        const Real measure = Real(2) * half_;
        const Real inverse = Real(1) / select(measure > Real(0), measure, Real(1));
        const auto lit = cap_.is_lit & (measure > Real(0)) & is_finite(inverse);
        measure_ = select(lit, measure, Real(0));
        inverse_measure_ = select(lit, inverse, Real(0));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit SphereProjectedSolidAngleUrena(
        const SphereProjectedSolidAngleUrena<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x leads across, u.y from the near side to the far side. Continuous in both.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Real signed_share = multiply_add(Real(2), u.x, Real(-1));
        const Real goal = abs(signed_share) * half_;
        Real low = Real(0), high = end_;
        Real y = abs(signed_share) * end_;
        for (int i = 0; i < kSteps; ++i) {
            const Real error = below(y) - goal;
            const auto above = error > Real(0);
            high = select(above, y, high);
            low = select(above, low, y);
            const Line line = line_at(y);
            const Real next = y - detail::over_positive(error, line.far - line.near);
            const auto inside = (next > low) & (next < high);
            y = select(inside, next, Real(0.5) * (low + high));
        }
        const Line line = line_at(y);
        const Real x = multiply_add(u.y, line.far - line.near, line.near);
        const Real z = sqrt(max((line.reach - x) * (line.reach + x), Real(0)));
        const Vec3<Real> wi =
            select(measure_ > Real(0), normalize(cap_.direction({x, copysign(y, signed_share)}, z)),
                   Vec3<Real>{Real(0), Real(0), Real(1)});
        return {wi, pdf(wi), cap_.distance(wi) * wi};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return max(wi.z, Real(0)) * inverse_measure_; }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec2<Real> p = cap_.projected(wi);
        const Real y = min(abs(p.y), end_);
        const Real share = copysign(min(detail::over_positive(below(y), half_), Real(1)), p.y);
        const Line line = line_at(y);
        return {below_one(Real(0.5) * (Real(1) + share)),
                below_one(detail::over_positive(max(p.x - line.near, Real(0)), line.far - line.near))};
    }

    /// Projected solid angle of the part above the horizon [sr].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    struct Line {
        Real near, far, reach; ///< reach: of the unit disk
    };

    NUSSELT_HD Real within_ellipse(const Real& y) const noexcept {
        return sqrt(max((cap_.sine - y) * (cap_.sine + y), Real(0)));
    }
    NUSSELT_HD static Real within_disk(const Real& y) noexcept {
        return sqrt(max((Real(1) - y) * (Real(1) + y), Real(0)));
    }

    NUSSELT_HD Line line_at(const Real& y) const noexcept {
        const Real half = cap_.axis.y * within_ellipse(y), reach = within_disk(y);
        return {cap_.middle - half, select(y < edge_, reach, cap_.middle + half), reach};
    }

    /// The area of half of the ellipse up to a distance from its long axis, negative if the centre is below the horizon.
    NUSSELT_HD Real ellipse_below(const Real& y) const noexcept {
        const Real root = within_ellipse(y);
        return Real(0.5) * cap_.axis.y * (y * root + cap_.sine * cap_.sine * atan2_positive(y, root));
    }
    /// The area between the long axis of the ellipse and the unit circle.
    NUSSELT_HD Real lune_below(const Real& y) const noexcept {
        const Real root = within_disk(y);
        return Real(0.5) * (y * root + atan2_positive(y, root)) - cap_.middle * y;
    }
    /// The area up to a line, on one side of the middle.
    NUSSELT_HD Real below(const Real& y) const noexcept {
        const Real ellipse = ellipse_below(y);
        return select(y < edge_, lune_below(y) + ellipse,
                      (at_edge_ - ellipse_at_edge_) + (ellipse + ellipse));
    }

    ProjectedCap<Real> cap_;
    Real edge_;                      ///< where the lune ends, 0 without one
    Real end_;                       ///< of the lines
    Real at_edge_, ellipse_at_edge_; ///< areas up to there
    Real half_;                      ///< of the whole area
    Real measure_, inverse_measure_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.cap_, self.edge_, self.end_, self.at_edge_, self.ellipse_at_edge_, self.half_,
              self.measure_, self.inverse_measure_);
    }
};

NUSSELT_NAMESPACE_END
