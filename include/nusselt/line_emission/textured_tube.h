#pragma once
/// Sampling of tubes of finite radius whose radiance varies along them, nearly in proportion to radiance times the cosine at the
/// surface, or times a glossy lobe.
///
/// Techniques for uniform tubes (sampling/cylinder_projected_solid_angle.h, cylinder_ltc.h) move along the axis with their
/// second random number, and hardly with the first one. It is warped by a piecewise linear density, in proportion to the
/// radiance of the places that it leads to. docs/techniques/textured_line.md has more.

#include <nusselt/geometry/cylinder.h>
#include <nusselt/line_emission/line_profile.h>
#include <nusselt/sampling/cylinder_ltc.h>
#include <nusselt/sampling/cylinder_projected_solid_angle.h>
#include <nusselt/sampling/piecewise_linear.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real      float, double, long double or a pack of float or double: one light and shading point per lane.
/// \tparam Technique CylinderProjectedSolidAngle<Real> or CylinderLtc<Real>: its measure, space and edge cases are those of
///                   this technique, too.
template <class Real, class Technique = CylinderProjectedSolidAngle<Real>>
class TexturedTube {
    using T = scalar_t<Real>;

public:
    /// \param technique for the light.
    /// \param light     in shading space [m].
    /// \param profile   of the radiance along it; it is not used later.
    template <int n>
    NUSSELT_HD TexturedTube(const Technique& technique, const Cylinder<Real>& light,
                            const LineProfile<T, n>& profile) noexcept
        : technique_(technique) {
        // Find the places of nodes, then the mean radiance around each of them.
        const auto points = technique.points_at(Real(T(0.5)));
        Real at[kNodes];
        for (int i = 0; i < kNodes; ++i) {
            constexpr T kLast = 1 - std::numeric_limits<T>::epsilon() / 2;
            const T y = min(PiecewiseLinear<Real, kNodes>::node(i), kLast);
            at[i] = place(light.axis, points(Real(y)));
        }
        const T mean = profile.below(T(1));
        Real value[kNodes];
        for (int i = 0; i < kNodes; ++i) {
            const Real begin = i > 0 ? Real(T(0.5)) * (at[i - 1] + at[i]) : at[i];
            const Real end = i < kNodes - 1 ? Real(T(0.5)) * (at[i] + at[i + 1]) : at[i];
            value[i] = per_lane(begin, end, [&](const T& from, const T& to) {
                const T least = min(from, to);
                const T length = max(from, to) - least;
                // A few texels are not lost to rounding.
                const T around = length > T(1e-4)
                                     ? (profile.below(least + length) - profile.below(least)) / length
                                     : mean_of_channels(profile.lookup(least));
                return mean > T(0) ? max(around, T(kLeast) * mean) / mean : T(0);
            });
        }
        along_ = PiecewiseLinear<Real, kNodes>(value);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves along it.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Real y = below_one(along_.invert(u.y));
        LightSample<Real> s = technique_.sample({u.x, y});
        s.pdf = density(s.pdf, y);
        return s;
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        return density(technique_.pdf(wi), technique_.invert(wi).y);
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec2<Real> u = technique_.invert(wi);
        const Real whole = along_.integral();
        return {u.x, select(whole > Real(0),
                            below_one(along_.below(u.y) / select(whole > Real(0), whole, Real(1))), Real(0))};
    }

    /// The measure of the technique times the radiance that it leads to, over the mean of the profile: good enough for weights of
    /// multiple importance sampling.
    NUSSELT_HD Real measure() const noexcept { return technique_.measure() * along_.integral(); }

private:
    static constexpr int kNodes = 33;
    /// Of the mean radiance, at all nodes: the first random number leads to slightly other places than the nodes, which may be
    /// brighter.
    static constexpr double kLeast = 0.1;

    /// The share of the axis before a point.
    NUSSELT_HD static Real place(const LineSegment<Real>& axis, const Vec3<Real>& p) noexcept {
        const auto has_length = axis.length > Real(0);
        const Real at = dot(p - axis.p0, axis.s) / select(has_length, axis.length, Real(1));
        // Comparisons with NaN are false.
        return select(at > Real(0), min(at, Real(1)), Real(0));
    }

    /// f(a, b) of each lane.
    template <class Function>
    NUSSELT_HD static Real per_lane(const Real& a, const Real& b, const Function& f) noexcept {
        if constexpr (std::is_same_v<Real, T>) {
            return f(a, b);
        } else {
            constexpr int kLanes = static_cast<int>(sizeof(Real) / sizeof(T));
            T from[kLanes];
            T to[kLanes];
            a.store(from);
            b.store(to);
            for (int i = 0; i < kLanes; ++i) from[i] = f(from[i], to[i]);
            return Real::load(from);
        }
    }

    NUSSELT_HD Real density(const Real& pdf, const Real& y) const noexcept {
        const Real whole = along_.integral();
        const auto lit = whole > Real(0);
        const Real density = pdf * (along_.value(y) / select(lit, whole, Real(1)));
        return select(lit & is_finite(density), density, Real(0));
    }

    Technique technique_;
    PiecewiseLinear<Real, kNodes> along_; ///< density of the second random number, not normalised
};

/// For glossy surfaces.
template <class Real>
using TexturedTubeLtc = TexturedTube<Real, CylinderLtc<Real>>;

NUSSELT_NAMESPACE_END
