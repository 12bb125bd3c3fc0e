#pragma once
/// Gauss-Legendre rules, found by the compiler.

#include <nusselt/core/config.h>

NUSSELT_NAMESPACE_BEGIN

/// A rule for the unit interval: exact for polynomials of degree 2 N - 1.
/// \tparam Scalar float, double or long double.
template <class Scalar, int N>
class GaussLegendre {
public:
    constexpr GaussLegendre() noexcept {
        for (int i = 0; i < N; ++i) {
            // A guess that Newton's method takes to node i from the right: the nodes are nearly cosines of equal steps.
            long double x = cosine((i + 0.75L) / (N + 0.5L));
            long double slope = 1;
            for (int iteration = 0; iteration < 8; ++iteration) {
                const Values p = legendre(x);
                slope = N * (x * p.value - p.previous) / (x * x - 1);
                x -= p.value / slope;
            }
            node_[i] = static_cast<Scalar>((1 - x) / 2);
            weight_[i] = static_cast<Scalar>(1 / ((1 - x * x) * slope * slope));
        }
    }

    /// Node i in (0, 1), increasing with i.
    constexpr Scalar node(int i) const noexcept { return node_[i]; }
    /// All of them add up to 1.
    constexpr Scalar weight(int i) const noexcept { return weight_[i]; }

private:
    struct Values {
        long double value, previous; ///< of the polynomials of degrees N and N - 1
    };

    static constexpr Values legendre(long double x) noexcept {
        long double previous = 1;
        long double value = x;
        for (int k = 2; k <= N; ++k) {
            const long double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
            previous = value;
            value = next;
        }
        return {value, previous};
    }

    /// cos(pi x) for x in [0, 1], to 1e-12.
    static constexpr long double cosine(long double x) noexcept {
        const long double angle = 3.14159265358979323846L * (x - 0.5L);
        long double term = -angle;
        long double sum = term;
        for (int k = 1; k < 10; ++k) {
            term *= -angle * angle / ((2 * k) * (2 * k + 1));
            sum += term;
        }
        return sum;
    }

    Scalar node_[N] = {};
    Scalar weight_[N] = {};
};

NUSSELT_NAMESPACE_END
