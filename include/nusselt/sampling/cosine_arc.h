#pragma once
/// Directions on an arc of a great circle with a density proportional to the cosine at the surface times the cosine of
/// the angle to the middle of the circle: the inner step of projected solid angle sampling of lines and tubes.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.2 and
/// 3.3, Algorithms 1 and 2. Deviations: the integral is written by the end points of the light, so that
/// nothing cancels (the paper accepts that short and distant lights lose precision); the unknown is the angle
/// from the start of the light; the initial guess takes the cosine with the normal into account; the iteration also
/// runs near the ends, where it needs no exception in this form.

#include <nusselt/core/broadcast.h>
#include <nusselt/geometry/clip_line.h>

NUSSELT_NAMESPACE_BEGIN

/// Steps of the iteration, at most: most lights need one. The largest backward error found in exact arithmetic is
/// 3.6e-5 after two and 1.3e-10 after three.
template <class Real>
inline constexpr int kLineIterations = kIsSingle<Real> ? 3 : 4;

/// A step of the iteration below it is the last one: its cube is rounding.
template <class Scalar>
inline constexpr Scalar kSmallStep = power_of_two<Scalar>(-std::numeric_limits<Scalar>::digits / 3);

/// \tparam Iterations steps of the iteration per sample, at most.
///
/// In terms of the angle alpha of LineExtent, the density is cos(alpha) n . w(alpha) / (integral() / 2).
template <class Real, int Iterations = kLineIterations<Real>>
class CosineArc {
public:
    /// Uninitialised: to be assigned to before it is used.
    CosineArc() = default;

    /// \param extent above the horizon.
    NUSSELT_HD explicit CosineArc(const LineExtent<Real>& extent) noexcept
        : extent_(extent), sweep_(extent_.sweep()) {
        const LinePoint<Real> middle = extent_.point_at(Real(0.5) * extent_.sine_extent);
        middle_height_ = max(fma(extent_.s.z, middle.sine, extent_.t.z * middle.cosine), Real(0));
        slope_ = extent_.s.z * extent_.c0 - extent_.t.z * extent_.s0;
        integral_ =
            cosine_integral(sweep_, extent_.sine_extent, extent_.height0 + extent_.height1, extent_.t.z);
    }

    /// Broadcasts an arc to all lanes of a pack.
    template <class Single>
    NUSSELT_HD explicit CosineArc(const CosineArc<Single, Iterations>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_HD const LineExtent<Real>& extent() const noexcept { return extent_; }

    /// E of the paper: 2 int cos(alpha) n . w(alpha) d alpha.
    NUSSELT_HD const Real& integral() const noexcept { return integral_; }

    /// \param u in [0, 1); increasing u moves from the start to the end.
    NUSSELT_HD LinePoint<Real> point(const Real& u) const noexcept {
        Real theta = angle_at(initial_sine(u));
        auto goes_on = mask_t<Real>(true);
        for (int i = 0; i < Iterations && any(goes_on); ++i) {
            const Rotation rotation = rotation_to(theta);
            const Real residual = fma(-u, integral_, rotation.integral); // Eq. 4
            // Laguerre's method (Algorithm 2): the root of the quadratic Taylor polynomial, in Blinn's stable form.
            const Real first = rotation.cosine * rotation.height;
            const Real second = fma(rotation.cosine, rotation.height_slope, -rotation.sine * rotation.height);
            const Real denominator = first + sqrt(max(fma(first, first, -second * residual), Real(0)));
            const Real step = residual / select(denominator > Real(0), denominator, Real(1));
            // Lanes that are done keep their result: it must not depend on their neighbours.
            theta = select(goes_on, min(max(theta - step, Real(0)), sweep_), theta);
            // The step leaves an error of the order of its cube, relative to the scale on which the density changes.
            goes_on =
                goes_on & (abs(step) * (first + abs(second)) > Real(kSmallStep<scalar_t<Real>>) * first);
        }
        const Real from_start = sine_from_start(sincos_quarter_turn(Real(0.5) * theta));
        return extent_.point_at(min(from_start, extent_.sine_extent));
    }

    /// The random number for which point() returns the one in direction wi, a unit direction on the arc.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept {
        const LinePoint<Real> point = extent_.point_in(wi);
        const Real theta = angle_at(point.from_start);
        const Real part =
            cosine_integral(theta, point.from_start, extent_.height0 + max(wi.z, Real(0)), extent_.t.z);
        return below_one(part / select(integral_ > Real(0), integral_, Real(1)));
    }

private:
    /// The quantities that the iteration needs at the angle theta from the start.
    struct Rotation {
        Real sine, cosine;         ///< of alpha
        Real height, height_slope; ///< cosine with the normal and its derivative
        Real integral;             ///< from the start
    };

    NUSSELT_HD Rotation rotation_to(const Real& theta) const noexcept {
        const SinCos<Real> half = sincos_quarter_turn(Real(0.5) * theta);
        const Real sin = Real(2) * half.sin * half.cos;
        const Real cos = fma(Real(-2) * half.sin, half.sin, Real(1));
        Rotation r;
        r.sine = fma(extent_.s0, cos, extent_.c0 * sin);
        r.cosine = max(fma(extent_.c0, cos, -extent_.s0 * sin), Real(0));
        r.height = max(fma(extent_.height0, cos, slope_ * sin), Real(0));
        r.height_slope = fma(slope_, cos, -extent_.height0 * sin);
        r.integral = cosine_integral(theta, sine_from_start(half), extent_.height0 + r.height, extent_.t.z);
        return r;
    }

    /// \param half sine and cosine of half the angle from the start.
    NUSSELT_HD Real sine_from_start(const SinCos<Real>& half) const noexcept {
        const Real middle = fma(extent_.c0, half.cos, -extent_.s0 * half.sin);
        return Real(2) * half.sin * max(middle, Real(0));
    }

    /// The angle from the start.
    NUSSELT_HD Real angle_at(const Real& from_start) const noexcept {
        const LinePoint<Real> point = extent_.point_at(from_start);
        return min(Real(2) * atan2_positive(from_start, extent_.c0 + point.cosine), sweep_);
    }

    /// The initial guess of the iteration: by sine, the density is the cosine with the normal. It is taken as linear
    /// from the start to the middle and from there to the end.
    NUSSELT_HD Real initial_sine(const Real& u) const noexcept {
        const Real first_half = extent_.height0 + middle_height_;
        const Real target = u * (first_half + middle_height_ + extent_.height1);
        const auto in_first = target < first_half;
        const Real low = select(in_first, extent_.height0, middle_height_);
        const Real rise =
            select(in_first, middle_height_ - extent_.height0, extent_.height1 - middle_height_);
        const Real rest = select(in_first, target, target - first_half);
        const Real denominator = low + sqrt(max(fma(rise, rest, low * low), Real(0)));
        const Real share = rest / select(denominator > Real(0), denominator, Real(1));
        return Real(0.5) * min(select(in_first, share, share + Real(1)), Real(2)) * extent_.sine_extent;
    }

    LineExtent<Real> extent_;
    Real sweep_;         ///< angle between the end points
    Real middle_height_; ///< cosine of the direction to the middle by sine with the normal
    Real slope_;         ///< derivative by theta of that cosine, at the start
    Real integral_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.extent_, self.sweep_, self.middle_height_, self.slope_, self.integral_);
    }
};

NUSSELT_NAMESPACE_END
