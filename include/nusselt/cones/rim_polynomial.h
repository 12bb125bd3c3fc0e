#pragma once
/// (1 - z^2) times a polynomial on [-1, 1], from its values at the nodes of Gauss's quadrature with the weight 1 - z^2.
///
/// The basis are Gegenbauer's polynomials C_k of parameter 3/2, whose integrals against the weight are those of
/// parameter 5/2, times (1 - z^2)^2: nothing cancels at the ends. Nodes have the digits of double, with long double,
/// too.

#include <nusselt/core/broadcast.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// The zeros of the derivative of Legendre's polynomial of degree Count + 1 that are positive, in increasing order.
template <int Count>
struct PositiveNodes;

template <>
struct PositiveNodes<16> {
    static constexpr double get(int i) noexcept {
        constexpr double kNodes[] = {0.08974909348465211102, 0.26636265287828098416, 0.43441503691212397534,
                                     0.58850483431866176117, 0.72367932928324268130, 0.83559353521809021371,
                                     0.92064918534753387383, 0.97610555741219854286};
        return kNodes[i];
    }
};

template <>
struct PositiveNodes<64> {
    static constexpr double get(int i) noexcept {
        constexpr double kNodes[] = {
            0.02398142066756300450, 0.07188910396496898204, 0.11963144001442616324, 0.16709861990954343091,
            0.21418146761167588130, 0.26077169105820536949, 0.30676213123762974379, 0.35204700865857223379,
            0.39652216664581404196, 0.44008531090374746203, 0.48263624479622646240, 0.52407709980163599052,
            0.56431256061308617567, 0.60325008436593524967, 0.64080011348832309002, 0.67687628168501798506,
            0.71139561258059690187, 0.74427871056473638535, 0.77544994340010829692, 0.80483761617193317023,
            0.83237413617744464629, 0.85799616837298789494, 0.88164478101544034965, 0.90326558115135277407,
            0.92280883961732928346, 0.94022960520694756608, 0.95548780759761579228, 0.96854834839456237811,
            0.97938117875580438566, 0.98796135811458488265, 0.99426906523986610999, 0.99828930255796696418};
        return kNodes[i];
    }
};

/// Coefficients of C_0, C_2, ... from sums, and of C_1, C_3, ... from differences, of the values at opposite nodes. The
/// node is the first index, so that the compiler adds the coefficients side by side.
template <class Scalar, int Count>
struct GegenbauerMatrix {
    static constexpr int kHalf = Count / 2;
    Scalar even[kHalf][kHalf], odd[kHalf][kHalf];

    constexpr GegenbauerMatrix() noexcept : even(), odd() {
        for (int i = 0; i < kHalf; ++i) {
            const double x = PositiveNodes<Count>::get(i);
            // The weight of Lobatto's quadrature is 2 / (n (n - 1) P^2) with the polynomial of degree
            // n - 1 = Count + 1.
            double below = 1, legendre = x;
            for (int k = 2; k <= Count + 1; ++k) {
                const double next = ((2 * k - 1) * x * legendre - (k - 1) * below) / k;
                below = legendre;
                legendre = next;
            }
            const double weight = 2.0 / ((Count + 1) * (Count + 2) * legendre * legendre);
            double before = 0, current = 1;
            for (int k = 0; k < Count; ++k) {
                const double norm = 2.0 * (k + 1) * (k + 2) / (2 * k + 3);
                (k % 2 == 0 ? even : odd)[i][k / 2] = static_cast<Scalar>(weight * current / norm);
                const double next = ((2 * k + 3) * x * current - (k + 2) * before) / (k + 1);
                before = current;
                current = next;
            }
        }
    }
};

/// The recurrences of both families: next = factor z current - lower before, and the integral's coefficient of each
/// term.
template <class Scalar, int Count>
struct GegenbauerRecurrence {
    Scalar factor[Count], lower[Count], integral_factor[Count], integral_lower[Count], integral[Count];

    constexpr GegenbauerRecurrence() noexcept
        : factor(), lower(), integral_factor(), integral_lower(), integral() {
        for (int k = 0; k < Count; ++k) {
            factor[k] = Scalar(2 * k + 3) / Scalar(k + 1);
            lower[k] = Scalar(-(k + 3)) / Scalar(k + 2);
            integral_factor[k] = Scalar(2 * k + 5) / Scalar(k + 1);
            integral_lower[k] = Scalar(-(k + 5)) / Scalar(k + 2);
            integral[k] = Scalar(3) / Scalar((k + 1) * (k + 4));
        }
    }
};

} // namespace detail

/// \tparam Real  float, double, long double or a pack.
/// \tparam Count of nodes, 16 or 64.
template <class Real, int Count>
class RimPolynomial {
    using Scalar = scalar_t<Real>;

public:
    static constexpr int kNodes = Count;
    /// In increasing order.
    static constexpr Scalar node(int i) noexcept {
        constexpr int kHalf = Count / 2;
        return static_cast<Scalar>(i < kHalf ? -detail::PositiveNodes<Count>::get(kHalf - 1 - i)
                                             : detail::PositiveNodes<Count>::get(i - kHalf));
    }

    RimPolynomial() = default;

    /// \param value at the nodes, not negative, of order one or less.
    NUSSELT_HD explicit RimPolynomial(const Real (&value)[Count]) noexcept {
        constexpr detail::GegenbauerMatrix<Scalar, Count> kMatrix;
        constexpr int kHalf = Count / 2;
        Real even[kHalf], odd[kHalf];
        for (int k = 0; k < kHalf; ++k) even[k] = odd[k] = Real(0);
        for (int i = 0; i < kHalf; ++i) {
            const Real sum = value[kHalf + i] + value[kHalf - 1 - i];
            const Real difference = value[kHalf + i] - value[kHalf - 1 - i];
            for (int k = 0; k < kHalf; ++k) {
                even[k] = multiply_add(Real(kMatrix.even[i][k]), sum, even[k]);
                odd[k] = multiply_add(Real(kMatrix.odd[i][k]), difference, odd[k]);
            }
        }
        for (int k = 0; k < kHalf; ++k) {
            coefficient_[2 * k] = even[k];
            coefficient_[2 * k + 1] = odd[k];
        }
    }

    template <class Single>
    NUSSELT_HD explicit RimPolynomial(const RimPolynomial<Single, Count>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// The integral from -1 to 1.
    NUSSELT_HD Real integral() const noexcept { return Real(Scalar(4) / 3) * coefficient_[0]; }

    /// Whether the last two coefficients are below a share of the first one.
    NUSSELT_HD mask_t<Real> converges(Scalar share) const noexcept {
        const Real tail = abs(coefficient_[Count - 1]) + abs(coefficient_[Count - 2]);
        return tail < Real(share) * coefficient_[0];
    }

    /// \param z in [-1, 1]
    /// \return a number that is not negative, by Clenshaw's scheme.
    NUSSELT_HD Real value(const Real& z) const noexcept {
        constexpr detail::GegenbauerRecurrence<Scalar, Count> kStep;
        Real current = Real(0), next = Real(0);
        NUSSELT_UNROLL
        for (int k = Count - 1; k >= 0; --k) {
            const Real lower = multiply_add(Real(kStep.lower[k]), next, coefficient_[k]);
            const Real sum = multiply_add(Real(kStep.factor[k]) * z, current, lower);
            next = current;
            current = sum;
        }
        return slope_of(z, current);
    }

    /// The integral from -1 to z in [-1, 1]. That of (1 - z^2) C_k is -3 / (k (k + 3)) (1 - z^2)^2 times the polynomial
    /// of parameter 5/2 and degree k - 1.
    NUSSELT_HD Real below(const Real& z) const noexcept {
        constexpr detail::GegenbauerRecurrence<Scalar, Count> kStep;
        Real current = Real(0), next = Real(0);
        NUSSELT_UNROLL
        for (int k = Count - 2; k >= 0; --k) {
            const Real own = Real(kStep.integral[k]) * coefficient_[k + 1];
            const Real lower = multiply_add(Real(kStep.integral_lower[k]), next, own);
            const Real sum = multiply_add(Real(kStep.integral_factor[k]) * z, current, lower);
            next = current;
            current = sum;
        }
        return integral_of(z, current);
    }

    /// One step of Newton's method for below(z) = goal, within [-1, 1].
    NUSSELT_HD Real refined(const Real& z, const Real& goal) const noexcept {
        // Both recurrences side by side: each waits for its own last term.
        constexpr detail::GegenbauerRecurrence<Scalar, Count> kStep;
        Real current = Real(0), next = Real(0), integral_current = Real(0), integral_next = Real(0);
        NUSSELT_UNROLL
        for (int k = Count - 1; k >= 0; --k) {
            const Real lower = multiply_add(Real(kStep.lower[k]), next, coefficient_[k]);
            const Real sum = multiply_add(Real(kStep.factor[k]) * z, current, lower);
            next = current;
            current = sum;
            if (k == 0) continue;
            const Real own = Real(kStep.integral[k - 1]) * coefficient_[k];
            const Real integral_lower = multiply_add(Real(kStep.integral_lower[k - 1]), integral_next, own);
            const Real integral_sum =
                multiply_add(Real(kStep.integral_factor[k - 1]) * z, integral_current, integral_lower);
            integral_next = integral_current;
            integral_current = integral_sum;
        }
        const Real slope = slope_of(z, current);
        const Real step = (integral_of(z, integral_current) - goal) / select(slope > Real(0), slope, Real(1));
        return select(slope > Real(0), min(max(z - step, Real(-1)), Real(1)), z);
    }

private:
    /// The density from the sum of polynomials of parameter 3/2.
    NUSSELT_HD static Real slope_of(const Real& z, const Real& sum) noexcept {
        return max((Real(1) - z) * (Real(1) + z) * sum, Real(0));
    }
    /// The integral from the sum of polynomials of parameter 5/2.
    NUSSELT_HD Real integral_of(const Real& z, const Real& sum) const noexcept {
        const Real up = Real(1) + z;
        const Real down = Real(1) - z;
        return up * up * (coefficient_[0] * ((Real(2) - z) * Real(Scalar(1) / 3)) - down * down * sum);
    }

    Real coefficient_[Count];

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.coefficient_);
    }
};

NUSSELT_NAMESPACE_END
