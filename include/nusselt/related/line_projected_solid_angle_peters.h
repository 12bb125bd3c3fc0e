#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as
/// printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Algorithms 1
/// and 2 with Eq. 1 to 3. Use LineProjectedSolidAngle instead: this one loses its precision for short and
/// distant lights, and gives NaN where the light points at the shading point or lies in the horizon.

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/line_segment.h>
#include <nusselt/related/peters_arithmetic.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double.
///
/// Measure and space as LineProjectedSolidAngle.
template <class Real>
class LineProjectedSolidAnglePeters {
public:
    /// \param light in shading space [m].
    explicit LineProjectedSolidAnglePeters(const LineSegment<Real>& light) noexcept
        : l0_(light.p0), s_(light.s), n_s_(light.s.z) {
        // Clip the line to the horizon.
        Real length = light.length;
        const Real start_height = l0_.z;
        const Real end_height = l0_.z + length * n_s_;
        const auto starts_below = start_height < Real(0);
        const auto ends_below = end_height < Real(0);
        if (any(starts_below | ends_below)) {
            const Real to_horizon = -start_height / n_s_;
            l0_ = l0_ + select(starts_below, to_horizon, Real(0)) * s_;
            length = select(starts_below, length - to_horizon, select(ends_below, to_horizon, length));
        }

        l0_s_ = dot(l0_, s_);
        const Real squared_l0 = dot(l0_, l0_);
        const Real squared_q = squared_l0 - l0_s_ * l0_s_;
        const Real end = l0_s_ + length;
        inverse_q_ = Real(1) / sqrt(squared_q);
        start_s_ = clamped(l0_s_ / sqrt(squared_l0));
        const Real end_s = clamped(end / sqrt(end * end + squared_q));
        extent_s_ = end_s - start_s_;
        n_t_ = inverse_q_ * (l0_.z - n_s_ * l0_s_);
        start_integral_ = integral(start_s_);
        total_ = integral(end_s) - start_integral_;
        const auto is_empty = (start_height <= Real(0)) & (end_height <= Real(0));
        total_ = select(is_empty, Real(0), total_);
    }

    /// \param u in [0, 1).
    /// \returns the direction alone, as the paper does; sample() adds density and point.
    Vec3<Real> direction(const Real& u) const noexcept {
        const Vec2<Real> w = invert(u);
        return along(w.x, inverse_q_ * w.y);
    }

    /// \param u in [0, 1).
    LightSample<Real> sample(const Real& u) const noexcept {
        const Vec2<Real> w = invert(u);
        const Real scaled_w_t = inverse_q_ * w.y;
        const Vec3<Real> wi = along(w.x, scaled_w_t);
        const Real cosine = w.x * n_s_ + w.y * n_t_;
        return {wi, cosine / measure(), (Real(1) / scaled_w_t) * wi};
    }

    /// Projected solid angle per radius of the part of the light above the horizon [sr/m].
    Real measure() const noexcept { return inverse_q_ * total_; }

private:
    static Real clamped(const Real& x) noexcept { return min(max(x, Real(-1)), Real(1)); }

    /// F of Eq. 3.
    NUSSELT_INLINE Real integral(const Real& w_s) const noexcept {
        const Real w_t = sqrt(Real(1) - w_s * w_s);
        return n_s_ * w_s * w_s + n_t_ * (w_t * w_s + peters::arcsine(w_s, w_t));
    }

    /// Algorithm 2.
    /// \returns w_s and w_t.
    Vec2<Real> invert(const Real& u) const noexcept {
        Vec2<Real> w;
        w.x = clamped(start_s_ + u * extent_s_);
        w.y = sqrt(Real(1) - w.x * w.x);
        const auto iterated = (u >= Real(1e-5)) & (u <= Real(1 - 1e-5));
        if (!any(iterated)) return w;
        const Vec2<Real> uniform = w;
        const Real target = u * total_ + start_integral_;
        Real alpha = peters::arcsine(w.x, w.y);
        NUSSELT_UNROLL
        for (int i = 0; i < 2; ++i) {
            const Real cosine = n_s_ * w.x + n_t_ * w.y;
            const Real residual = cosine * w.x + n_t_ * alpha - target;
            const Real first = Real(2) * cosine * w.y;
            const Real second = Real(2) * (n_s_ * w.y - n_t_ * w.x) * w.y - Real(2) * cosine * w.x;
            // The root of smaller magnitude of second / 2 x^2 + first x + residual, or the extremum.
            const Real root = sqrt(max(first * first - Real(2) * second * residual, Real(0)));
            const Real step = Real(-2) * residual / (first + copysign(root, first));
            constexpr scalar_t<Real> kQuarter = kPi<scalar_t<Real>> / 2;
            alpha = min(max(alpha + step, Real(-kQuarter)), Real(kQuarter));
            const SinCos<Real> turned = peters::sincos_around_zero(alpha);
            w = {turned.sin, turned.cos};
        }
        return select(iterated, w, uniform);
    }

    /// The direction w_s s + w_t t, given w_t over the distance of the line.
    Vec3<Real> along(const Real& w_s, const Real& scaled_w_t) const noexcept {
        return (w_s - scaled_w_t * l0_s_) * s_ + scaled_w_t * l0_;
    }

    Vec3<Real> l0_, s_;
    Real n_s_, n_t_;
    Real l0_s_, inverse_q_, start_s_, extent_s_;
    Real start_integral_, total_;
};

NUSSELT_NAMESPACE_END
