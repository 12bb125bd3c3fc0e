#pragma once
/// A distribution on [-1, 1] whose density is nearly (1 - z^2) times a smooth function. z is the place on a rim, or a
/// function of it with which densities that do not vanish at an end get a zero there (solid_sweep.h, lune_sweep.h).
///
/// 16 places of the density give a polynomial (rim_polynomial.h). Where its last coefficients tell that it is not
/// accurate, 64 places take over if the caller asks for them; where those do not suffice either, the density is linear
/// between the first 16 places.

#include <nusselt/cones/rim_polynomial.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// \name Places of the rim of a cone that the horizon cuts: the two values of the template parameter Places.
/// @{
/// Suffice for ordinary lights.
inline constexpr int kConePlaces = 16;
/// Where kConePlaces do not suffice, take as many as this. Other lights have the same samples and cost the same.
inline constexpr int kFineConePlaces = 64;
/// @}

namespace detail {

/// Stands where a distribution has no second polynomial.
template <class Real>
struct NoPolynomial {
    NoPolynomial() = default;
    template <class Single>
    NUSSELT_HD explicit NoPolynomial(const NoPolynomial<Single>&) noexcept {}
};

} // namespace detail

/// \tparam Real   float, double, long double or a pack.
/// \tparam Places kConePlaces, or kFineConePlaces.
template <class Real, int Places>
class RimDistribution {
    static_assert(Places == kConePlaces || Places == kFineConePlaces,
                  "Places is kConePlaces (16) or kFineConePlaces (64)");
    using Scalar = scalar_t<Real>;
    using Coarse = RimPolynomial<Real, kConePlaces>;
    static constexpr int kNodes = Coarse::kNodes;
    static constexpr bool kRefines = Places == kFineConePlaces;
    using Fine = std::conditional_t<kRefines, RimPolynomial<Real, Places>, detail::NoPolynomial<Real>>;

public:
    RimDistribution() = default;

    /// \param fill functor: fill.template operator()<Nodes>(value) writes the density at Nodes::node(i) to value[i]. It
    ///             is not negative, not normalised, of order one or less.
    template <class Fill>
    NUSSELT_HD explicit RimDistribution(const Fill& fill) noexcept : fine_() {
        fill.template operator()<Coarse>(value_);
        coarse_ = Coarse(value_);
        below_[0] = Real((node(0) + 1) / 2) * value_[0];
        for (int i = 1; i < kNodes; ++i)
            below_[i] = below_[i - 1] + Real((node(i) - node(i - 1)) / 2) * (value_[i - 1] + value_[i]);
        below_[kNodes] = below_[kNodes - 1] + Real((1 - node(kNodes - 1)) / 2) * value_[kNodes - 1];

        constexpr Scalar kRounding = 16 * std::numeric_limits<Scalar>::epsilon();
        is_exact_ = coarse_.converges(kRounding);
        is_close_ = coarse_.converges(Scalar(kPositive));
        is_coarse_ = is_close_;
        is_fine_ = mask_t<Real>(false);
        if constexpr (kRefines) {
            is_coarse_ = coarse_.converges(kIsSingle<Real> ? Scalar(kAccurate) : kRounding);
            if (all(is_coarse_)) return;
            Real finer[Places];
            fill.template operator()<Fine>(finer);
            fine_ = Fine(finer);
            is_fine_ = mask_t<Real>((!is_coarse_) & fine_.converges(Scalar(kPositive)));
            is_exact_ = is_exact_ | (is_fine_ & fine_.converges(kRounding));
        }
    }

    template <class Single>
    NUSSELT_HD explicit RimDistribution(const RimDistribution<Single, Places>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// The integral of the density.
    NUSSELT_HD Real integral() const noexcept {
        Real rough = below_[kNodes];
        if constexpr (kRefines) rough = select(is_fine_, fine_.integral(), rough);
        return select(is_coarse_, coarse_.integral(), rough);
    }

    /// Whether the interpolant differs from the function by rounding only.
    NUSSELT_HD const mask_t<Real>& is_exact() const noexcept { return is_exact_; }

    /// \param u in [0, 1)
    /// \return z with below(z) = u integral(), increasing with u.
    NUSSELT_HD Real invert(const Real& u) const noexcept {
        const Real goal = u * integral();
        const Real start = invert_linear(u);
        Real z = start;
        if (any(is_close_)) {
            const Real coarse_goal = select(is_coarse_, goal, u * coarse_.integral());
            Real refined = start;
            NUSSELT_UNROLL
            for (int i = 0; i < kSteps; ++i) refined = coarse_.refined(refined, coarse_goal);
            z = select(is_close_, refined, z);
        }
        if constexpr (kRefines) {
            if (!any(is_fine_)) return z;
            Real refined = z;
            for (int i = 0; i < kSteps; ++i) refined = fine_.refined(refined, goal);
            if (!all(is_close_)) {
                Real from_linear = refined;
                for (int i = 0; i < kSteps; ++i) from_linear = fine_.refined(from_linear, goal);
                refined = select(is_close_, refined, from_linear);
            }
            z = select(is_fine_, refined, z);
        }
        return z;
    }

    /// \param z in [-1, 1]
    NUSSELT_HD Real value(const Real& z) const noexcept {
        if (all(is_coarse_)) return coarse_.value(z);
        const Segment s = segment([&](int i) { return z >= Real(node(i)); });
        Real rough = multiply_add((z - s.begin) / s.width, s.right - s.left, s.left);
        if constexpr (kRefines) rough = select(is_fine_, fine_.value(z), rough);
        return select(is_coarse_, coarse_.value(z), rough);
    }

    /// The integral from -1 to z in [-1, 1].
    NUSSELT_HD Real below(const Real& z) const noexcept {
        if (all(is_coarse_)) return coarse_.below(z);
        const Segment s = segment([&](int i) { return z >= Real(node(i)); });
        const Real share = (z - s.begin) / s.width;
        Real rough =
            multiply_add(s.width * share, multiply_add(Real(0.5) * share, s.right - s.left, s.left), s.below);
        if constexpr (kRefines) rough = select(is_fine_, fine_.below(z), rough);
        return select(is_coarse_, coarse_.below(z), rough);
    }

private:
    /// The error of the integral up to any place is a twentieth of the last coefficients.
    static constexpr double kAccurate = 1e-5;
    /// Polynomials whose last two coefficients exceed this fraction of the first one may be negative.
    static constexpr double kPositive = 1e-3;
    /// Steps of Newton's method from one interpolant to the next; twice as many from the linear one to that of 64
    /// places.
    static constexpr int kSteps = kIsSingle<Real> ? 2 : 4;

    static constexpr Scalar node(int i) noexcept { return Coarse::node(i); }

    struct Segment {
        Real begin, width, left, right, below;
    };

    template <class Reaches>
    NUSSELT_HD Segment segment(const Reaches& reaches) const noexcept {
        Segment s{Real(-1), Real(node(0) + 1), Real(0), value_[0], Real(0)};
        NUSSELT_UNROLL
        for (int i = 0; i < kNodes; ++i) {
            const auto inside = reaches(i);
            const Scalar end = i + 1 < kNodes ? node(i + 1) : Scalar(1);
            s.begin = select(inside, Real(node(i)), s.begin);
            s.width = select(inside, Real(end - node(i)), s.width);
            s.left = select(inside, value_[i], s.left);
            s.right = select(inside, i + 1 < kNodes ? value_[i + 1] : Real(0), s.right);
            s.below = select(inside, below_[i], s.below);
        }
        return s;
    }

    NUSSELT_HD Real invert_linear(const Real& u) const noexcept {
        const Real goal = u * below_[kNodes];
        const Segment s = segment([&](int i) { return goal >= below_[i]; });
        const Real rest = max(goal - s.below, Real(0)) / s.width;
        const Real root =
            sqrt(max(multiply_add(Real(2) * (s.right - s.left), rest, s.left * s.left), Real(0)));
        const Real denominator = s.left + root;
        const Real share = Real(2) * rest / select(denominator > Real(0), denominator, Real(1));
        return multiply_add(min(share, Real(1)), s.width, s.begin);
    }

    Coarse coarse_;
    Fine fine_; ///< set only where the coarse one does not suffice in any lane
    Real value_[kNodes];
    Real below_[kNodes + 1]; ///< integrals of the linear interpolant up to the nodes, and to 1
    mask_t<Real> is_close_;  ///< whether the coarse polynomial is positive
    mask_t<Real> is_coarse_, is_fine_, is_exact_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.coarse_, self.fine_, self.value_, self.below_, self.is_close_, self.is_coarse_,
              self.is_fine_, self.is_exact_);
    }
};

NUSSELT_NAMESPACE_END
