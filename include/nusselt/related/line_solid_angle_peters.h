#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as
/// printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.5,
/// Algorithm 1 without the lines for the normal, and Eq. 1 in the limit of a thin cylinder. Use LineSolidAngle
/// instead: this one takes short and distant lights from the difference of two sines, and gives NaN where the
/// light points at the shading point.

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/line_segment.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double.
///
/// Measure and space as LineSolidAngle.
template <class Real>
class LineSolidAnglePeters {
public:
    /// \param light relative to the shading point [m].
    explicit LineSolidAnglePeters(const LineSegment<Real>& light) noexcept
        : l0_(light.p0), s_(light.s), l0_s_(dot(light.p0, light.s)) {
        const Real squared_l0 = dot(l0_, l0_);
        const Real squared_q = squared_l0 - l0_s_ * l0_s_;
        const Real end = l0_s_ + light.length;
        inverse_q_ = Real(1) / sqrt(squared_q);
        start_s_ = l0_s_ / sqrt(squared_l0);
        extent_s_ = end / sqrt(end * end + squared_q) - start_s_;
    }

    /// \param u in [0, 1).
    /// \returns the direction alone, as the paper does; sample() adds density and point.
    Vec3<Real> direction(const Real& u) const noexcept {
        const Real w_s = start_s_ + u * extent_s_;
        return along(w_s, inverse_q_ * cosine(w_s));
    }

    /// \param u in [0, 1).
    LightSample<Real> sample(const Real& u) const noexcept {
        const Real w_s = start_s_ + u * extent_s_;
        const Real scaled_w_t = inverse_q_ * cosine(w_s);
        const Vec3<Real> wi = along(w_s, scaled_w_t);
        return {wi, Real(1) / measure(), (Real(1) / scaled_w_t) * wi};
    }

    /// Solid angle per radius [sr/m].
    Real measure() const noexcept { return Real(2) * inverse_q_ * extent_s_; }

private:
    static Real cosine(const Real& w_s) noexcept { return sqrt(max(Real(1) - w_s * w_s, Real(0))); }
    /// The direction w_s s + w_t t, given w_t over the distance of the line.
    Vec3<Real> along(const Real& w_s, const Real& scaled_w_t) const noexcept {
        return (w_s - scaled_w_t * l0_s_) * s_ + scaled_w_t * l0_;
    }

    Vec3<Real> l0_, s_;
    Real l0_s_, inverse_q_, start_s_, extent_s_;
};

NUSSELT_NAMESPACE_END
