#pragma once
/// A distribution on [-1, 1] whose density is nearly (1 - z^2) times a smooth function, known at 16 places.
///
/// The density is (1 - z^2) times a polynomial of degree 15 in the basis of Gegenbauer's polynomials C_k of parameter 3/2,
/// whose integrals against the weight 1 - z^2 are those of parameter 5/2, times (1 - z^2)^2: nothing cancels at the ends.
/// The places are the nodes of Gauss's quadrature with this weight. Where the last coefficients tell that the polynomial is not
/// to be trusted, the density is piecewise linear instead.

#include <nusselt/core/broadcast.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// Nodes, and the matrix from values of the density at the nodes to coefficients.
struct GegenbauerNodes {
    static constexpr int kCount = 16;

    /// Nodes in increasing order: the zeros of the derivative of Legendre's polynomial of degree 17.
    static constexpr double node(int i) noexcept {
        constexpr double kPositive[] = {
            0.08974909348465211102, 0.26636265287828098416, 0.43441503691212397534, 0.58850483431866176117,
            0.72367932928324268130, 0.83559353521809021371, 0.92064918534753387383, 0.97610555741219854286};
        return i < kCount / 2 ? -kPositive[kCount / 2 - 1 - i] : kPositive[i - kCount / 2];
    }
    /// Weights of Lobatto's quadrature with 18 nodes: those of the weight 1 - z^2 over 1 - z^2.
    static constexpr double weight(int i) noexcept {
        constexpr double kPositive[] = {
            0.17901586343970308229, 0.17326210948945622601, 0.16193951723760248926, 0.14541196157380226798,
            0.12421053313296710026, 0.09901627171750280239, 0.07063716688563366499, 0.03997062881091406613};
        return kPositive[i < kCount / 2 ? kCount / 2 - 1 - i : i - kCount / 2];
    }
};

/// Row k gives the coefficient of C_k from sums (k even) or differences (k odd) of the values at opposite nodes.
template <class Scalar>
struct GegenbauerMatrix {
    static constexpr int kHalf = GegenbauerNodes::kCount / 2;
    Scalar entry[GegenbauerNodes::kCount][kHalf];

    constexpr GegenbauerMatrix() noexcept : entry() {
        for (int i = 0; i < kHalf; ++i) {
            const double x = GegenbauerNodes::node(kHalf + i);
            double before = 0, current = 1;
            for (int k = 0; k < GegenbauerNodes::kCount; ++k) {
                const double norm = 2.0 * (k + 1) * (k + 2) / (2 * k + 3);
                entry[k][i] = static_cast<Scalar>(GegenbauerNodes::weight(kHalf + i) * current / norm);
                const double next = ((2 * k + 3) * x * current - (k + 2) * before) / (k + 1);
                before = current;
                current = next;
            }
        }
    }
};

} // namespace detail

/// \tparam Real float, double, long double or a pack.
template <class Real>
class RimDistribution {
    using Scalar = scalar_t<Real>;

public:
    static constexpr int kNodes = detail::GegenbauerNodes::kCount;
    static constexpr Scalar node(int i) noexcept {
        return static_cast<Scalar>(detail::GegenbauerNodes::node(i));
    }

    RimDistribution() = default;

    /// \param value of the density at the nodes, not negative, not normalised, of order one or less.
    NUSSELT_HD explicit RimDistribution(const Real (&value)[kNodes]) noexcept {
        constexpr detail::GegenbauerMatrix<Scalar> kMatrix;
        constexpr int kHalf = kNodes / 2;
        for (int k = 0; k < kNodes; ++k) {
            Real sum = Real(0);
            NUSSELT_UNROLL
            for (int i = 0; i < kHalf; ++i) {
                const Real& right = value[kHalf + i];
                const Real& left = value[kHalf - 1 - i];
                sum = multiply_add(Real(kMatrix.entry[k][i]), k % 2 == 0 ? right + left : right - left, sum);
            }
            coefficient_[k] = sum;
        }
        below_[0] = Real((node(0) + 1) / 2) * value[0];
        value_[0] = value[0];
        for (int i = 1; i < kNodes; ++i) {
            value_[i] = value[i];
            below_[i] = below_[i - 1] + Real((node(i) - node(i - 1)) / 2) * (value[i - 1] + value[i]);
        }
        below_[kNodes] = below_[kNodes - 1] + Real((1 - node(kNodes - 1)) / 2) * value[kNodes - 1];

        const Real tail = abs(coefficient_[kNodes - 1]) + abs(coefficient_[kNodes - 2]);
        is_polynomial_ = tail < Real(Scalar(kLargestTail)) * coefficient_[0];
        is_exact_ = tail < Real(16 * std::numeric_limits<Scalar>::epsilon()) * coefficient_[0];
    }

    template <class Single>
    NUSSELT_HD explicit RimDistribution(const RimDistribution<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// The integral of the density.
    NUSSELT_HD Real integral() const noexcept {
        return select(is_polynomial_, Real(Scalar(4) / 3) * coefficient_[0], below_[kNodes]);
    }

    /// Whether the interpolant differs from the function by rounding only.
    NUSSELT_HD const mask_t<Real>& is_exact() const noexcept { return is_exact_; }

    /// \param u in [0, 1)
    /// \return z with below(z) = u integral(), increasing with u.
    NUSSELT_HD Real invert(const Real& u) const noexcept {
        Real z = invert_linear(u);
        if (any(is_polynomial_)) {
            // Where the interpolants are close enough for the polynomial to be used, two steps have errors below 1e-6.
            constexpr int kSteps = kIsSingle<Real> ? 2 : 4;
            const Real goal = u * integral();
            Real refined = z;
            NUSSELT_UNROLL
            for (int i = 0; i < kSteps; ++i) {
                const Real slope = polynomial_value(refined);
                const Real step =
                    (polynomial_below(refined) - goal) / select(slope > Real(0), slope, Real(1));
                refined = select(slope > Real(0), min(max(refined - step, Real(-1)), Real(1)), refined);
            }
            z = select(is_polynomial_, refined, z);
        }
        return z;
    }

    /// \param z in [-1, 1]
    NUSSELT_HD Real value(const Real& z) const noexcept {
        if (all(is_polynomial_)) return polynomial_value(z);
        const Segment s = segment([&](int i) { return z >= Real(node(i)); });
        const Real linear = multiply_add((z - s.begin) / s.width, s.right - s.left, s.left);
        return select(is_polynomial_, polynomial_value(z), linear);
    }

    /// The integral from -1 to z in [-1, 1].
    NUSSELT_HD Real below(const Real& z) const noexcept {
        if (all(is_polynomial_)) return polynomial_below(z);
        const Segment s = segment([&](int i) { return z >= Real(node(i)); });
        const Real share = (z - s.begin) / s.width;
        const Real linear =
            multiply_add(s.width * share, multiply_add(Real(0.5) * share, s.right - s.left, s.left), s.below);
        return select(is_polynomial_, polynomial_below(z), linear);
    }

private:
    /// Polynomials whose last two coefficients exceed this fraction of the first one may be negative.
    static constexpr double kLargestTail = 1e-3;

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

    /// Clenshaw's scheme for the polynomials of parameter 3/2.
    NUSSELT_HD Real polynomial_value(const Real& z) const noexcept {
        Real current = Real(0), next = Real(0);
        NUSSELT_UNROLL
        for (int k = kNodes - 1; k >= 0; --k) {
            const Real lower = multiply_add(Real(Scalar(-(k + 3)) / Scalar(k + 2)), next, coefficient_[k]);
            const Real sum = multiply_add(Real(Scalar(2 * k + 3) / Scalar(k + 1)) * z, current, lower);
            next = current;
            current = sum;
        }
        return max((Real(1) - z) * (Real(1) + z) * current, Real(0));
    }

    /// The integral of (1 - z^2) C_k is -3 / (k (k + 3)) (1 - z^2)^2 times the polynomial of parameter 5/2 and degree k - 1.
    NUSSELT_HD Real polynomial_below(const Real& z) const noexcept {
        Real current = Real(0), next = Real(0);
        NUSSELT_UNROLL
        for (int n = kNodes - 2; n >= 0; --n) {
            const Real own = Real(Scalar(3) / Scalar((n + 1) * (n + 4))) * coefficient_[n + 1];
            const Real lower = multiply_add(Real(Scalar(-(n + 5)) / Scalar(n + 2)), next, own);
            const Real sum = multiply_add(Real(Scalar(2 * n + 5) / Scalar(n + 1)) * z, current, lower);
            next = current;
            current = sum;
        }
        const Real up = Real(1) + z;
        const Real down = Real(1) - z;
        return up * up * (coefficient_[0] * ((Real(2) - z) * Real(Scalar(1) / 3)) - down * down * current);
    }

    Real coefficient_[kNodes];
    Real value_[kNodes];
    Real below_[kNodes + 1]; ///< integrals of the linear interpolant up to the nodes, and to 1
    mask_t<Real> is_polynomial_, is_exact_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.coefficient_, self.value_, self.below_, self.is_polynomial_, self.is_exact_);
    }
};

NUSSELT_NAMESPACE_END
