#pragma once
/// Warps of uniform random numbers to polynomial densities on the unit interval and the unit square. Composed with a
/// technique, they bring a factor of the integrand into its density.
///
/// D. Hart, M. Pharr, T. Müller, W. Lopes, M. McGuire, P. Shirley 2020, Practical Product Sampling by Fitting and Composing
/// Warps, CGF 39(4), doi:10.1111/cgf.14060. Densities are in Bernstein form. Values of the target are their control values,
/// so no density is ever negative; quadratic ones meet the target in their corners only. All are sampled exactly: on the
/// square, y from its marginal density and then x from its conditional density. Warps of the square are for fans: the
/// whole edge y = 0 is the apex of the fan and has one value (C. Peters 2021, BRDF Importance Sampling for Polygonal Lights,
/// Sec. 6.6).
///
/// Each warp has
///
///     sample(u)   the point of the unit interval or square for uniform random numbers in [0, 1), itself in [0, 1)
///     density(x)  of this point; the mean over the interval or the square is 1
///     invert(x)   the random numbers for which sample() returns x
///
/// and is uniform where all values are zero, or less than four times the smallest normal number. Points where the density
/// is 0 only result from u = 0.

#include <limits>

#include <nusselt/core/broadcast.h>

NUSSELT_NAMESPACE_BEGIN
namespace hart {

/// The least sum of values whose reciprocal is finite.
template <class Real>
inline constexpr scalar_t<Real> kLeastSum = 4 * std::numeric_limits<scalar_t<Real>>::min();

/// A sample of the density that is linear between values at 0 and 1, not negative, not normalised: the root in a form without
/// cancellation. 0 where both values are 0.
template <class Real>
NUSSELT_INLINE Real sample_linear(const Real& at_0, const Real& at_1, const Real& u) noexcept {
    const Real squares = multiply_add(Real(1) - u, at_0 * at_0, u * (at_1 * at_1));
    const Real denominator = at_0 + sqrt(squares);
    return below_one(u * (at_0 + at_1) / select(denominator > Real(0), denominator, Real(1)));
}

/// A density that is linear between its values at 0 and 1.
template <class Real>
class LinearWarp {
public:
    /// Uninitialised: to be assigned to before it is used.
    LinearWarp() = default;

    /// \param at_0, at_1 values of the target, not negative, not normalised.
    NUSSELT_INLINE LinearWarp(const Real& at_0, const Real& at_1) noexcept {
        const Real sum = at_0 + at_1;
        const auto positive = sum > Real(kLeastSum<Real>);
        const Real scale = Real(2) / select(positive, sum, Real(1));
        at_0_ = select(positive, scale * at_0, Real(1));
        at_1_ = select(positive, scale * at_1, Real(1));
    }

    /// \param target not needed: values in the interior.
    template <class Target>
    NUSSELT_INLINE static LinearWarp fit(const Real& at_0, const Real& at_1, const Target&) noexcept {
        return LinearWarp(at_0, at_1);
    }

    template <class Single>
    NUSSELT_HD explicit LinearWarp(const LinearWarp<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_INLINE Real sample(const Real& u) const noexcept { return sample_linear(at_0_, at_1_, u); }

    NUSSELT_INLINE Real density(const Real& x) const noexcept {
        return multiply_add(Real(1) - x, at_0_, x * at_1_);
    }

    NUSSELT_INLINE Real invert(const Real& x) const noexcept {
        // Both values sum up to 2.
        return below_one(x * multiply_add(Real(1) - x, at_0_, x));
    }

private:
    Real at_0_, at_1_; ///< with mean 1

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.at_0_, self.at_1_);
    }
};

/// A quadratic density with the values p, q, r of the target at 0, 1/2 and 1 as control values:
/// p (1 - x)^2 + 2 q x (1 - x) + r x^2. With p + q + r = 3, its distribution function is the sum of positive terms
/// F(x) = x (p (1 - x)^2 + x ((p + q) (1 - x) + x)).
template <class Real>
class QuadraticWarp {
public:
    /// Uninitialised: to be assigned to before it is used.
    QuadraticWarp() = default;

    /// \param p, q, r values of the target at 0, 1/2 and 1, not negative, not normalised.
    NUSSELT_INLINE QuadraticWarp(const Real& p, const Real& q, const Real& r) noexcept {
        const Real sum = p + q + r;
        const auto positive = sum > Real(kLeastSum<Real>);
        const Real scale = Real(3) / select(positive, sum, Real(1));
        p_ = select(positive, scale * p, Real(1));
        q_ = select(positive, scale * q, Real(1));
        r_ = select(positive, scale * r, Real(1));
    }

    /// \param target function that returns the value at a point of the interval.
    template <class Target>
    NUSSELT_INLINE static QuadraticWarp fit(const Real& at_0, const Real& at_1,
                                            const Target& target) noexcept {
        return QuadraticWarp(at_0, target(Real(0.5)), at_1);
    }

    template <class Single>
    NUSSELT_HD explicit QuadraticWarp(const QuadraticWarp<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// The distribution function is inverted by an iteration instead of a formula for the roots of cubics: its error is one
    /// of rounding for all values and random numbers, and packs need no case distinction.
    NUSSELT_INLINE Real sample(const Real& u) const noexcept {
        // Search in the half [0, 1/2] of the density or of its mirror image.
        const Real half = Real(Scalar(1) / 24) * multiply_add(Real(7), p_, multiply_add(Real(4), q_, r_));
        const auto mirrored = u > half;
        const Real p = select(mirrored, r_, p_);
        const Real r = select(mirrored, p_, r_);
        const Real x = invert_half(p, r, select(mirrored, Real(1) - u, u));
        return below_one(select(mirrored, Real(1) - x, x));
    }

    NUSSELT_INLINE Real density(const Real& x) const noexcept {
        const Real w = Real(1) - x;
        return multiply_add(w, multiply_add(p_, w, Real(2) * q_ * x), r_ * x * x);
    }

    NUSSELT_INLINE Real invert(const Real& x) const noexcept {
        return below_one(distribution(p_, x, Real(1) - x));
    }

private:
    using Scalar = scalar_t<Real>;
    /// Steps after which the error is one of rounding. The start deviates in F by up to a factor of 2.1; the first step
    /// leaves an error of 3 %, the second one 2e-6, the third one less than 1e-16, relative to F.
    static constexpr int kSteps = std::is_same_v<Scalar, float> ? 2 : std::is_same_v<Scalar, double> ? 3 : 4;

    /// \param w 1 - x.
    NUSSELT_INLINE Real distribution(const Real& p, const Real& x, const Real& w) const noexcept {
        return x * multiply_add(p * w, w, x * multiply_add(p + q_, w, x));
    }

    /// Solves F(x) = u for x in [0, 1/2], with p and r in the order of the half.
    NUSSELT_INLINE Real invert_half(const Real& p, const Real& r, const Real& u) const noexcept {
        // F(x) = p x + (q - p) x^2 + (1 - q) x^3. Combine the root for the terms up to the second order with that for the
        // third order as reciprocal squares. Roots of u stand for its third root: u^(5/16) is within 30 % of it down to
        // 1e-7.
        const Real slope = Real(0.5) * (p + sqrt(max(multiply_add(p, p, Real(4) * (q_ - p) * u), Real(0))));
        const Real fourth_root = sqrt(sqrt(u));
        const Real cubic =
            max(Real(1) - q_, Real(0)) * (Real(Scalar(1.4L)) * u) * (fourth_root * sqrt(fourth_root));
        const Real norm = sqrt(multiply_add(slope, slope, cubic));
        Real x = min(u / select(norm > Real(0), norm, Real(1)), Real(0.5));

        // Halley's method: it finds roots of powers without their slope vanishing first.
        NUSSELT_UNROLL
        for (int i = 0; i < kSteps; ++i) {
            const Real w = Real(1) - x;
            const Real error = distribution(p, x, w) - u;
            const Real slope_x = multiply_add(w, multiply_add(p, w, Real(2) * q_ * x), r * x * x);
            const Real half_curvature = multiply_add(q_ - p, w, (r - q_) * x);
            const Real denominator = multiply_add(slope_x, slope_x, -error * half_curvature);
            const Real step = error * slope_x / select(denominator > Real(0), denominator, Real(1));
            x = min(max(x - step, Real(0)), Real(0.5));
        }
        return x;
    }

    Real p_, q_, r_; ///< control values with mean 1

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.p_, self.q_, self.r_);
    }
};

/// Values of a target in the corners of the unit square of a fan.
template <class Real>
struct FanCorners {
    Real apex;        ///< on the whole edge y = 0
    Real first, last; ///< at (0, 1) and at (1, 1)
};

/// A bilinear density on the unit square of a fan.
template <class Real>
class BilinearWarp {
public:
    /// \param value of the target, not negative, not normalised.
    NUSSELT_INLINE explicit BilinearWarp(const FanCorners<Real>& value) noexcept
        : marginal_(Real(2) * value.apex, value.first + value.last) {
        const Real sum = Real(2) * value.apex + (value.first + value.last);
        const auto positive = sum > Real(kLeastSum<Real>);
        const Real scale = Real(4) / select(positive, sum, Real(1));
        apex_ = select(positive, scale * value.apex, Real(1));
        first_ = select(positive, scale * value.first, Real(1));
        last_ = select(positive, scale * value.last, Real(1));
    }

    /// \param target not needed: values in the interior.
    template <class Target>
    NUSSELT_INLINE static BilinearWarp fit(const FanCorners<Real>& value, const Target&) noexcept {
        return BilinearWarp(value);
    }

    template <class Single>
    NUSSELT_HD explicit BilinearWarp(const BilinearWarp<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_INLINE Vec2<Real> sample(const Vec2<Real>& u) const noexcept {
        const Real y = marginal_.sample(u.y);
        const Row row(*this, y);
        return {sample_linear(row.first, row.last, u.x), y};
    }

    NUSSELT_INLINE Real density(const Vec2<Real>& x) const noexcept {
        const Row row(*this, x.y);
        return multiply_add(Real(1) - x.x, row.first, x.x * row.last);
    }

    NUSSELT_INLINE Vec2<Real> invert(const Vec2<Real>& x) const noexcept {
        const Row row(*this, x.y);
        return {LinearWarp<Real>(row.first, row.last).invert(x.x), marginal_.invert(x.y)};
    }

private:
    /// Values at both ends of a row of the square.
    struct Row {
        Real first, last;

        NUSSELT_INLINE Row(const BilinearWarp& warp, const Real& y) noexcept
            : first(multiply_add(Real(1) - y, warp.apex_, y * warp.first_)),
              last(multiply_add(Real(1) - y, warp.apex_, y * warp.last_)) {}
    };

    LinearWarp<Real> marginal_;
    Real apex_, first_, last_; ///< with mean 1

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.marginal_, self.apex_, self.first_, self.last_);
    }
};

/// A biquadratic density on the unit square of a fan: quadratic in x for each y, and the reverse.
template <class Real>
class BiquadraticWarp {
public:
    /// \param apex   value of the target on the edge y = 0.
    /// \param middle values at x = 0, 1/2, 1 and y = 1/2.
    /// \param end    values at x = 0, 1/2, 1 and y = 1. All are not negative and not normalised.
    NUSSELT_INLINE BiquadraticWarp(const Real& apex, const Vec3<Real>& middle, const Vec3<Real>& end) noexcept
        : marginal_(Real(3) * apex, sum_of(middle), sum_of(end)) {
        const Real sum = Real(3) * apex + (sum_of(middle) + sum_of(end));
        const auto positive = sum > Real(kLeastSum<Real>);
        const Real scale = Real(9) / select(positive, sum, Real(1));
        const Vec3<Real> ones{Real(1), Real(1), Real(1)};
        apex_ = select(positive, scale * apex, Real(1));
        middle_ = select(positive, scale * middle, ones);
        end_ = select(positive, scale * end, ones);
    }

    /// \param target function that returns the value at a point of the square.
    template <class Target>
    NUSSELT_INLINE static BiquadraticWarp fit(const FanCorners<Real>& value, const Target& target) noexcept {
        // Random numbers do not reach one.
        const Real half = Real(0.5);
        const Real one = below_one(Real(1));
        constexpr int kPoints = 4;
        const Vec2<Real> point[kPoints] = {{Real(0), half}, {half, half}, {one, half}, {half, one}};
        Real at[kPoints];
        for (int i = 0; i < kPoints; ++i) at[i] = target(point[i]);
        return BiquadraticWarp(value.apex, {at[0], at[1], at[2]}, {value.first, at[3], value.last});
    }

    template <class Single>
    NUSSELT_HD explicit BiquadraticWarp(const BiquadraticWarp<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    NUSSELT_INLINE Vec2<Real> sample(const Vec2<Real>& u) const noexcept {
        const Real y = marginal_.sample(u.y);
        const Vec3<Real> row = row_at(y);
        return {QuadraticWarp<Real>(row.x, row.y, row.z).sample(u.x), y};
    }

    NUSSELT_INLINE Real density(const Vec2<Real>& x) const noexcept {
        const Vec3<Real> row = row_at(x.y);
        const Real w = Real(1) - x.x;
        return multiply_add(w, multiply_add(row.x, w, Real(2) * row.y * x.x), row.z * x.x * x.x);
    }

    NUSSELT_INLINE Vec2<Real> invert(const Vec2<Real>& x) const noexcept {
        const Vec3<Real> row = row_at(x.y);
        return {QuadraticWarp<Real>(row.x, row.y, row.z).invert(x.x), marginal_.invert(x.y)};
    }

private:
    NUSSELT_INLINE static Real sum_of(const Vec3<Real>& v) noexcept { return v.x + v.y + v.z; }

    /// The control values of a row of the square.
    NUSSELT_INLINE Vec3<Real> row_at(const Real& y) const noexcept {
        const Real w = Real(1) - y;
        const Real at_apex = w * w * apex_;
        const Real to_middle = Real(2) * w * y;
        const Real to_end = y * y;
        return {multiply_add(to_end, end_.x, multiply_add(to_middle, middle_.x, at_apex)),
                multiply_add(to_end, end_.y, multiply_add(to_middle, middle_.y, at_apex)),
                multiply_add(to_end, end_.z, multiply_add(to_middle, middle_.z, at_apex))};
    }

    QuadraticWarp<Real> marginal_;
    Real apex_;
    Vec3<Real> middle_, end_; ///< with mean 1, as the apex

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.marginal_, self.apex_, self.middle_, self.end_);
    }
};

} // namespace hart
NUSSELT_NAMESPACE_END
