#pragma once
/// Uniform sampling of the projected solid angle of a linear light: density proportional to the cosine at the
/// surface. With a Lambertian tube on a Lambertian surface, all noise that remains comes from shadows.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.2 and
/// 3.3, Algorithms 1 and 2. Deviations: the integral is written by the end points of the light, so that
/// nothing cancels (the paper accepts that short and distant lights lose precision); the unknown is the angle
/// from the begin of the light; the iteration also runs near the ends, where it needs no exception in this
/// form.

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/clip_line.h>

NUSSELT_NAMESPACE_BEGIN

/// Steps of the iteration. The worst backward error in exact arithmetic is 1.6e-5 after two, 2e-7 after three
/// and 3e-12 after four.
template <class Real>
inline constexpr int kLineIterations = kIsSingle<Real> ? 2 : 4;

/// \tparam Real       float, double, long double or a pack of float or double: one light and shading point
///                    per lane, or many samples of one light (see the broadcasting constructor).
/// \tparam Iterations steps of the iteration per sample.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr],
/// wi.z / measure(). The emission of the light is radiance times radius, so that the radius cancels.
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no part above the horizon, no length, or origin on the infinite line: pdf = 0, measure 0.
template <class Real, int Iterations = kLineIterations<Real>>
class LineProjectedSolidAngle {
public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit LineProjectedSolidAngle(const LineSegment<Real>& light) noexcept {
        const Real scale = scale_of(light);
        inverse_scale_ = Real(1) / scale;
        extent_ = clipped_extent(scaled(light, scale));
        slope_ = extent_.s.z * extent_.c0 - extent_.t.z * extent_.s0;
        integral_ = cosine_integral(extent_.sweep, extent_.sin_sweep, extent_.tan_half_sweep,
                                    extent_.c0 + extent_.c1, extent_.d0.z + extent_.d1.z, extent_.t.z);
        const Real measure = integral_ / select(extent_.visible, extent_.distance, Real(1)) * scale;
        const auto lit = extent_.visible & (measure > Real(0)) & is_finite(measure);
        measure_ = select(lit, measure, Real(0));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit LineProjectedSolidAngle(
        const LineProjectedSolidAngle<Single, Iterations>& single) noexcept
        : extent_(broadcast<Real>(single.extent_)),
          inverse_scale_(single.inverse_scale_),
          slope_(single.slope_),
          integral_(single.integral_),
          measure_(single.measure_) {}

    /// \param u in [0, 1); increasing u moves from the begin of the light to its end.
    NUSSELT_HD LightSample<Real> sample(const Real& u) const noexcept {
        // The start samples the solid angle uniformly.
        const Real tangent = extent_.tan_half_at_fraction(u);
        LinePoint<Real> point = extent_.point_at(tangent);
        Real theta = Real(2) * atan2_positive(tangent, Real(1));
        for (int i = 0; i < Iterations; ++i) {
            // Laguerre's method: the root of the quadratic Taylor polynomial, in Blinn's stable form.
            const Real h = height(point);
            const Real residual = integral_to(theta, point, h) - u * integral_;
            const Real first = point.c * h;
            const Real height_slope = fma(slope_, point.cos, -extent_.d0.z * point.sin);
            const Real second = fma(point.c, height_slope, -point.s * h);
            const Real denominator = first + sqrt(max(fma(first, first, -second * residual), Real(0)));
            const Real step = residual / select(denominator > Real(0), denominator, Real(1));
            theta = min(max(theta - step, Real(0)), extent_.sweep);
            const SinCos<Real> angle = sincos_half_turn(theta);
            point = extent_.point_at(angle.sin, angle.cos, tan_half(angle));
        }
        Vec3<Real> wi = extent_.direction(point);
        wi.z = height(point);
        return {wi, pdf(wi), inverse_scale_ * extent_.position(point)};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const auto lit = (measure_ > Real(0)) & (wi.z > Real(0));
        const Real density = wi.z / select(lit, measure_, Real(1));
        return select(lit & is_finite(density), density, Real(0));
    }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept {
        const LinePoint<Real> point = extent_.point_in(wi);
        const Real theta = min(atan2_positive(point.sin, point.cos), extent_.sweep);
        const Real part = integral_to(theta, point, height(point));
        return below_one(part / select(integral_ > Real(0), integral_, Real(1)));
    }

    /// Projected solid angle per radius of the part of the light above the horizon [sr/m].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    template <class, int>
    friend class LineProjectedSolidAngle;

    /// Cosine with the normal.
    NUSSELT_HD Real height(const LinePoint<Real>& point) const noexcept {
        return extent_.interpolate(point, extent_.d0.z, extent_.d1.z, slope_);
    }

    NUSSELT_HD Real integral_to(const Real& theta, const LinePoint<Real>& point,
                                const Real& h) const noexcept {
        return cosine_integral(theta, point.sin, point.tan_half, extent_.c0 + point.c, extent_.d0.z + h,
                               extent_.t.z);
    }

    NUSSELT_HD static Real tan_half(const SinCos<Real>& angle) noexcept {
        const auto acute = angle.cos > Real(0);
        const Real tangent =
            select(acute, angle.sin, Real(1) - angle.cos) /
            select(acute, Real(1) + angle.cos, select(angle.sin > Real(0), angle.sin, Real(1)));
        return min(tangent, Real(kLargestTangent<scalar_t<Real>>));
    }

    LineExtent<Real> extent_; ///< of the part above the horizon, scaled to an extent of order one
    Real inverse_scale_;
    Real slope_;    ///< derivative of the cosine with the normal by theta, at the begin
    Real integral_; ///< E of the paper
    Real measure_;
};

NUSSELT_NAMESPACE_END
