#pragma once
/// Directions on an arc of a great circle with a density proportional to the cosine at the surface times the cosine of
/// the angle to the middle of the circle: the inner step of projected solid angle sampling of lines and tubes.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.2 and
/// 3.3, Algorithms 1 and 2. Deviations: the integral is written by the end points of the light, so that nothing cancels
/// (the paper accepts that short and distant lights lose precision); the unknown is the sine of the angle, counted from the
/// middle of the light, so that a step needs one polynomial instead of trigonometric functions; the initial guess is exact
/// at both ends and in the middle; the iteration also runs near the ends, where it needs no exception in this form.

#include <nusselt/core/broadcast.h>
#include <nusselt/geometry/clip_line.h>

NUSSELT_NAMESPACE_BEGIN

/// Steps of the iteration, at most: most lights need one.
template <class Real>
inline constexpr int kLineIterations = kIsSingle<Real> ? 3 : 4;

/// \tparam Iterations steps of the iteration per sample, at most.
///
/// In terms of the angle alpha of LineExtent, the density is cos(alpha) n . w(alpha) / (integral() / 2).
template <class Real, int Iterations = kLineIterations<Real>>
class CosineArc {
public:
    /// Uninitialised: to be assigned to before it is used.
    CosineArc() = default;

    /// \param extent above the horizon.
    NUSSELT_INLINE explicit CosineArc(const LineExtent<Real>& extent) noexcept
        : map_(extent), distance_(extent.distance), n_t_(extent.n_t()) {
        const CosineIntegral<Real> halves(extent, n_t_);
        middle_cosine_ = halves.middle_cosine;
        middle_height_ = halves.middle_height;
        from_near_ = halves.from_near;
        const Real to_far = halves.to_far;
        // Without light, the denominators are 0; any values will do that keep the formulas finite.
        const Real least = Real(std::numeric_limits<scalar_t<Real>>::min());
        inverse_sine_extent_ = Real(1) / max(map_.sine_extent, least);
        integral_ = halves.near + halves.far;

        // A random number, which counts from the start, becomes a share of the integral, which counts from the middle.
        const Real near_share = halves.near * inverse_integral();
        share_scale_ = extent.line.sign;
        share_offset_ = multiply_add(Real(-0.5), share_scale_, Real(0.5)) - near_share;

        // Choose the slopes of the height for which first_guess() is exact at the ends, and interpolate between them.
        const Real near_inverse = Real(1) / max(from_near_, least);
        const Real far_inverse = Real(1) / max(to_far, least);
        const Real near_slope =
            near_inverse * multiply_add(near_inverse, halves.bend, extent.near_height() - middle_height_);
        const Real far_slope =
            far_inverse * multiply_add(far_inverse, halves.bend, extent.far_height() - middle_height_);
        guess_linear_ = multiply_add(far_slope, halves.near, -near_slope * halves.far);
        guess_square_ = (far_slope + near_slope) * integral_;
    }

    /// Broadcasts an arc to all lanes of a pack.
    template <class Single>
    NUSSELT_HD explicit CosineArc(const CosineArc<Single, Iterations>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_HD const LineMap<Real>& map() const noexcept { return map_; }

    /// E of the paper: 2 int cos(alpha) n . w(alpha) d alpha.
    NUSSELT_HD const Real& integral() const noexcept { return integral_; }
    /// Its reciprocal; finite if it is 0.
    NUSSELT_INLINE Real inverse_integral() const noexcept {
        return Real(1) / max(integral_, Real(std::numeric_limits<scalar_t<Real>>::min()));
    }

    /// \param u in [0, 1); increasing u moves from the start to the end.
    NUSSELT_INLINE LinePoint<Real> point(const Real& u) const noexcept {
        using Scalar = scalar_t<Real>;
        const Real share = multiply_add(u, share_scale_, share_offset_);
        const Real target = share * integral_;
        const Real tolerance = Real(Scalar(1.5) * std::numeric_limits<Scalar>::epsilon()) * integral_;
        const Real guess = first_guess(share, target) + from_near_;
        Real x = min(max(guess * inverse_sine_extent_, Real(0)), Real(1));
        auto goes_on = mask_t<Real>(true);
        for (int i = 0; i < Iterations && any(goes_on); ++i) {
            // Laguerre's method (Algorithm 2): the root of the quadratic Taylor polynomial, in Blinn's stable form. All
            // derivatives by the sine are multiplied by the cosine.
            const Real sine = map_.sine_at(x);
            const Real cosine = distance_ * map_.point_at(x).inverse_distance;
            const Real height = max(multiply_add(map_.inward.z, sine, n_t_ * cosine), Real(0));
            const Real residual = integral_to(x, cosine, height) - target; // Eq. 4
            const Real first = cosine * height;
            const Real second = cosine * multiply_add(map_.inward.z, cosine, -n_t_ * sine);
            const Real root = sqrt(max(multiply_add(first, first, -second * residual), Real(0)));
            const Real step = residual / max(first + root, Real(kTiny<Scalar>));
            // Lanes that are done keep their result: it must not depend on their neighbours.
            const Real next = multiply_add(-step * cosine, inverse_sine_extent_, x);
            x = select(goes_on, min(max(next, Real(0)), Real(1)), x);
            // What the quadratic polynomial lacks of the integral is a third of this cube, if the cosine changes little.
            const auto is_exact = abs(n_t_ * step * step * step) <= tolerance;
            const auto is_local = abs(Real(4) * step * sine) <= cosine;
            goes_on = goes_on & !(is_exact & is_local);
        }
        return map_.point_at(x);
    }

    /// The random number for which point() returns the one in direction wi, a unit direction on the arc.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept {
        const Real x = map_.share_in(wi);
        const Real cosine = distance_ * map_.point_at(x).inverse_distance;
        const Real part = integral_to(x, cosine, max(wi.z, Real(0)));
        return below_one((part * inverse_integral() - share_offset_) * share_scale_);
    }

private:
    /// The integral from the middle to a point, see CosineIntegral.
    /// \param x as LinePoint::share.
    NUSSELT_INLINE Real integral_to(const Real& x, const Real& cosine, const Real& height) const noexcept {
        const Real sine = multiply_add(x, map_.sine_extent, -from_near_);
        const Real half_tangent = sine / (middle_cosine_ + cosine);
        return multiply_add(sine, middle_height_ + height, n_t_ * angle_minus_sine(half_tangent));
    }

    /// By sine, the density is the cosine with the normal. Were that linear, the sample would solve a quadratic equation.
    /// Its slope is taken as a linear function of the integral instead of a constant.
    NUSSELT_HD Real first_guess(const Real& share, const Real& target) const noexcept {
        const Real change = share * multiply_add(share, guess_square_, guess_linear_);
        const Real squared = max(multiply_add(middle_height_, middle_height_, change), Real(0));
        return target / (middle_height_ + sqrt(squared));
    }

    LineMap<Real> map_;
    Real distance_;                      ///< of the line from the origin
    Real n_t_;                           ///< component of the normal along t
    Real middle_cosine_, middle_height_; ///< of the middle by angle
    Real from_near_;                     ///< sine of that middle minus that of the near end
    Real inverse_sine_extent_;
    Real integral_;
    Real share_scale_, share_offset_;
    Real guess_linear_, guess_square_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.map_, self.distance_, self.n_t_, self.middle_cosine_, self.middle_height_, self.from_near_,
              self.inverse_sine_extent_, self.integral_, self.share_scale_, self.share_offset_,
              self.guess_linear_, self.guess_square_);
    }
};

NUSSELT_NAMESPACE_END
