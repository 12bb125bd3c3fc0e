#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as
/// printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Algorithms 1
/// and 2 with Eq. 1 to 3. Use LineProjectedSolidAngle instead: this one loses its precision for short and
/// distant lights, and gives NaN where the light points at the shading point or lies in the horizon.

#include <cmath>

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/line_segment.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double or long double.
///
/// Measure and space as LineProjectedSolidAngle.
template <class Real>
class LineProjectedSolidAnglePeters {
public:
    /// \param light in shading space [m].
    explicit LineProjectedSolidAnglePeters(const LineSegment<Real>& light) noexcept
        : l0_(light.p0), s_(light.s) {
        Real length = light.length;
        const Real start_height = l0_.z;
        const Real end_height = l0_.z + length * s_.z;
        if (start_height <= Real(0) && end_height <= Real(0)) return;
        if (start_height < Real(0)) {
            const Real below = -start_height / s_.z;
            l0_ = l0_ + below * s_;
            length -= below;
        } else if (end_height < Real(0)) {
            length = -start_height / s_.z;
        }
        l0_s_ = dot(l0_, s_);
        const Real q2 = dot(l0_, l0_) - l0_s_ * l0_s_;
        inverse_q_ = Real(1) / sqrt(q2);
        start_s_ = clamped(l0_s_ / sqrt(dot(l0_, l0_)));
        end_s_ = clamped((l0_s_ + length) / sqrt((l0_s_ + length) * (l0_s_ + length) + q2));
        n_s_ = s_.z;
        n_t_ = inverse_q_ * (l0_.z - n_s_ * l0_s_);
        start_integral_ = integral(start_s_);
        total_ = integral(end_s_) - start_integral_;
    }

    /// \param u in [0, 1).
    /// \returns the direction alone, as the paper does; sample() adds density and point.
    Vec3<Real> direction(const Real& u) const noexcept { return along(invert(u)); }

    /// \param u in [0, 1).
    LightSample<Real> sample(const Real& u) const noexcept {
        const Vec2<Real> w = invert(u);
        const Vec3<Real> wi = along(w);
        const Real cosine = w.x * n_s_ + w.y * n_t_;
        return {wi, cosine / measure(), (Real(1) / (w.y * inverse_q_)) * wi};
    }

    /// Projected solid angle per radius of the part of the light above the horizon [sr/m].
    Real measure() const noexcept { return inverse_q_ * total_; }

private:
    static Real clamped(const Real& x) noexcept { return min(max(x, Real(-1)), Real(1)); }

    /// F of Eq. 3.
    Real integral(const Real& w_s) const noexcept {
        return n_s_ * w_s * w_s + n_t_ * (sqrt(Real(1) - w_s * w_s) * w_s + std::asin(w_s));
    }

    /// Algorithm 2: w_s and w_t.
    Vec2<Real> invert(const Real& u) const noexcept {
        Real w_s = clamped(start_s_ + u * (end_s_ - start_s_));
        Real w_t = sqrt(Real(1) - w_s * w_s);
        if (u >= Real(1e-5) && u <= Real(1 - 1e-5)) {
            const Real target = u * total_ + start_integral_;
            Real alpha = std::asin(w_s);
            for (int i = 0; i < 2; ++i) {
                const Real along = n_s_ * w_s + n_t_ * w_t;
                const Real residual = along * w_s + n_t_ * alpha - target;
                const Real first = Real(2) * along * w_t;
                const Real second = Real(2) * (n_s_ * w_t - n_t_ * w_s) * w_t - Real(2) * along * w_s;
                // The root of smaller magnitude of second / 2 x^2 + first x + residual, or the extremum.
                const Real discriminant = first * first - Real(2) * second * residual;
                const Real root = sqrt(max(discriminant, Real(0)));
                const Real step = Real(-2) * residual / (first >= Real(0) ? first + root : first - root);
                alpha = min(max(alpha + step, Real(-kPi<Real> / 2)), Real(kPi<Real> / 2));
                w_s = std::sin(alpha);
                w_t = std::cos(alpha);
            }
        }
        return {w_s, w_t};
    }

    /// The direction w_s s + w_t t.
    Vec3<Real> along(const Vec2<Real>& w) const noexcept {
        const Real scaled_w_t = inverse_q_ * w.y;
        return (w.x - scaled_w_t * l0_s_) * s_ + scaled_w_t * l0_;
    }

    Vec3<Real> l0_, s_;
    Real l0_s_ = 0, inverse_q_ = 0, start_s_ = 0, end_s_ = 0, n_s_ = 0, n_t_ = 0;
    Real start_integral_ = 0, total_ = 0;
};

NUSSELT_NAMESPACE_END
