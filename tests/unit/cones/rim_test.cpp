/// Tests of the cycloid and its inverse, and of the distribution of places of the rim.

#include <cmath>

#include <gtest/gtest.h>

#include <nusselt/cones/cycloid.h>
#include <nusselt/cones/rim_distribution.h>

namespace nusselt_test {
namespace {

using nusselt::RimDistribution;

TEST(CycloidTest, CubeRootsHaveFewRoundings) {
    for (double exponent = -9; exponent < 1.3; exponent += 0.01) {
        const double x = std::pow(10, exponent);
        const double tolerance = exponent < -6 ? 3e-6 : 3e-7;
        EXPECT_NEAR(nusselt::cube_root(static_cast<float>(x)) / std::cbrt(x), 1, tolerance) << x;
    }
    EXPECT_EQ(nusselt::cube_root(0.0f), 0);
}

template <class T>
void expect_inverse(double tolerance) {
    for (int i = 1; i < 400; ++i) {
        const T largest = static_cast<T>(3.1415) * static_cast<T>(i) / 400;
        const T fraction = nusselt::cycloid_fraction(largest, std::sin(largest), std::cos(largest));
        for (int k = 0; k <= 20; ++k) {
            const T u = static_cast<T>(k) / 20;
            const long double x =
                2 * static_cast<long double>(nusselt::inverse_cycloid(u, largest, fraction));
            const long double end = 2 * static_cast<long double>(largest);
            const long double share = (x - std::sin(x)) / (end - std::sin(end));
            EXPECT_NEAR(static_cast<double>(share), static_cast<double>(u), tolerance) << largest;
        }
    }
}

TEST(CycloidTest, InverseIsOne) {
    expect_inverse<float>(3e-6);
    expect_inverse<double>(1e-13);
}

TEST(CycloidTest, TinyAnglesAreCubic) {
    const float largest = 1e-30f;
    EXPECT_NEAR(nusselt::inverse_cycloid(0.125f, largest, nusselt::cycloid_fraction(largest, largest, 1.0f)) /
                    largest,
                0.5f, 1e-6f);
}

/// Writes the values of a function at nodes.
template <class Function>
struct Fill {
    const Function& f;

    template <class Nodes>
    void operator()(double (&value)[Nodes::kNodes]) const {
        for (int i = 0; i < Nodes::kNodes; ++i) value[i] = f(Nodes::node(i));
    }
};

template <class Function>
RimDistribution<double, nusselt::kFineConePlaces> distribution_of(const Function& f) {
    return RimDistribution<double, nusselt::kFineConePlaces>(Fill<Function>{f});
}

TEST(RimDistributionTest, PolynomialsAreExact) {
    const auto f = [](double z) { return (1 - z * z) * (2 + z - 0.5 * z * z * z + std::pow(z, 6)); };
    const auto below = [](double z) { // by terms
        const auto power = [z](int n) { return (std::pow(z, n + 1) - std::pow(-1.0, n + 1)) / (n + 1); };
        return 2 * (power(0) - power(2)) + power(1) - power(3) - 0.5 * (power(3) - power(5)) + power(6) -
               power(8);
    };
    const auto distribution = distribution_of(f);
    EXPECT_TRUE(distribution.is_exact());
    EXPECT_NEAR(distribution.integral(), below(1), 1e-14);
    for (double u = 0.001; u < 1; u += 0.037) {
        const double z = distribution.invert(u);
        EXPECT_NEAR(below(z) / below(1), u, 2e-13);
        EXPECT_NEAR(distribution.value(z), f(z), 1e-13);
        EXPECT_NEAR(distribution.below(z), below(z), 1e-14);
    }
}

/// 16 places do not suffice, 64 do.
TEST(RimDistributionTest, SteepDensitiesTakeMorePlaces) {
    const auto f = [](double z) { return (1 - z * z) / (0.04 + (z - 0.3) * (z - 0.3)); };
    const auto distribution = distribution_of(f);
    // The integral by panels of Simpson's rule.
    double sum = 0;
    constexpr int kPanels = 4000;
    for (int i = 0; i < kPanels; ++i) {
        const double begin = -1 + 2.0 * i / kPanels, width = 2.0 / kPanels;
        sum += width / 6 * (f(begin) + 4 * f(begin + width / 2) + f(begin + width));
    }
    EXPECT_NEAR(distribution.integral() / sum, 1, 1e-9);
    for (double u = 0.001; u < 1; u += 0.037) {
        const double z = distribution.invert(u);
        EXPECT_NEAR(distribution.value(z), f(z), 1e-4);
        EXPECT_NEAR(distribution.below(z) / distribution.integral(), u, 1e-9);
    }
}

/// A peak that no polynomial of this degree follows.
TEST(RimDistributionTest, RoughDensitiesAreInterpolatedLinearly) {
    const auto distribution =
        distribution_of([](double z) { return 1e-3 + 1 / (1e-4 + (z - 0.3) * (z - 0.3)); });
    EXPECT_FALSE(distribution.is_exact());
    double sum = 0;
    constexpr int kCount = 100'000;
    for (int i = 0; i < kCount; ++i) {
        const double z = 2 * (i + 0.5) / kCount - 1;
        ASSERT_GE(distribution.value(z), 0);
        sum += distribution.value(z) * 2 / kCount;
    }
    EXPECT_NEAR(sum / distribution.integral(), 1, 1e-6);
    for (double u = 0.001; u < 1; u += 0.037)
        EXPECT_NEAR(distribution.below(distribution.invert(u)) / distribution.integral(), u, 1e-12);
}

} // namespace
} // namespace nusselt_test
