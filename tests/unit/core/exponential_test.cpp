/// Tests of core/exponential.h: its documented error bounds hold, and packs have the bits of scalars.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <nusselt/core/exponential.h>
#include <nusselt/core/gauss_legendre.h>
#include <nusselt/simd/pack.h>

#include "geometry/reference.h"

namespace nusselt_test {
namespace {

using nusselt::exp_of_negative;
using nusselt::GaussLegendre;
using nusselt::negative_log_of_cosine;
using nusselt::SinCos;

TEST(ExponentialTest, ExponentialIsPreciseInFloat) {
    long double largest = 0;
    for (int i = 0; i < 870'000; ++i) {
        const float x = static_cast<float>(i) * 1e-4f;
        const long double exact = std::exp(-static_cast<long double>(x));
        largest = std::max(largest, std::fabs(exp_of_negative(x) - exact) / exact);
    }
    EXPECT_LE(largest, 2e-7L);
    EXPECT_GT(largest, 1e-8L);
}

TEST(ExponentialTest, ExponentialOfExtremes) {
    EXPECT_EQ(exp_of_negative(0.0f), 1);
    EXPECT_EQ(exp_of_negative(1e30f), 0);
    EXPECT_EQ(exp_of_negative(std::numeric_limits<float>::infinity()), 0);
    EXPECT_EQ(exp_of_negative(std::numeric_limits<double>::infinity()), 0);
}

TEST(ExponentialTest, LogarithmOfCosineIsPrecise) {
    long double largest_float = 0;
    long double largest_double = 0;
    const auto check = [&](long double angle) {
        const long double s = std::sin(angle);
        const long double exact = s < 0.5L ? -std::log1p(-s * s) / 2 : -std::log(std::cos(angle));
        const SinCos<float> in_float{static_cast<float>(s), static_cast<float>(std::cos(angle))};
        const SinCos<double> in_double{static_cast<double>(s), static_cast<double>(std::cos(angle))};
        // The rounding error of the argument counts twice because the sine is squared.
        largest_float = std::max(largest_float, std::fabs(negative_log_of_cosine(in_float) - exact) / exact);
        largest_double =
            std::max(largest_double, std::fabs(negative_log_of_cosine(in_double) - exact) / exact);
    };
    for (int i = 1; i < 400'000; ++i) check(kPi / 2 * i / 400'000);
    for (long double angle = 1e-14L; angle < 1; angle *= 1.3L) {
        check(angle);
        check(kPi / 2 - angle);
    }
    EXPECT_LE(largest_float, 6e-7L);
    EXPECT_GT(largest_float, 1e-8L);
    EXPECT_LE(largest_double, 1e-15L);
}

TEST(ExponentialTest, LogarithmOfCosineOfExtremes) {
    EXPECT_EQ(negative_log_of_cosine(SinCos<float>{0, 1}), 0);
    EXPECT_GE(negative_log_of_cosine(SinCos<float>{1, 0}), 34);
    EXPECT_LT(negative_log_of_cosine(SinCos<float>{1, 0}), 35);
    EXPECT_GE(negative_log_of_cosine(SinCos<double>{1, 0}), 34);
    EXPECT_LT(negative_log_of_cosine(SinCos<double>{1, 0}), 35);
}

template <class T, int N>
void expect_packs_equal_scalars() {
    using Pack = nusselt::Pack<T, N>;
    for (int k = 0; k < 20'000; k += N) {
        Pack x{};
        SinCos<Pack> angle{};
        for (int i = 0; i < N; ++i) {
            const T share = static_cast<T>(k + i) / 20'000;
            x.set_lane(i, 100 * share);
            angle.sin.set_lane(i, std::sin(share * T(1.5707963)));
            angle.cos.set_lane(i, std::cos(share * T(1.5707963)));
        }
        const Pack power = exp_of_negative(x);
        const Pack logarithm = negative_log_of_cosine(angle);
        for (int i = 0; i < N; ++i) {
            EXPECT_EQ(power.lane(i), exp_of_negative(x.lane(i)));
            EXPECT_EQ(logarithm.lane(i),
                      negative_log_of_cosine(SinCos<T>{angle.sin.lane(i), angle.cos.lane(i)}));
        }
    }
}

TEST(ExponentialTest, PacksEqualScalars) {
    expect_packs_equal_scalars<float, 4>();
    expect_packs_equal_scalars<float, 8>();
    expect_packs_equal_scalars<double, 4>();
}

template <int N>
void expect_rule() {
    constexpr GaussLegendre<double, N> kRule;
    // The rule is exact for monomials up to degree 2 N - 1, but not for the next one.
    for (int degree = 0; degree <= 2 * N; ++degree) {
        double sum = 0;
        for (int i = 0; i < N; ++i) sum += kRule.weight(i) * std::pow(kRule.node(i), degree);
        const double exact = 1.0 / (degree + 1);
        if (degree < 2 * N) {
            EXPECT_NEAR(sum, exact, 1e-15) << N << ", degree " << degree;
        } else if (N <= 8) {
            EXPECT_GT(std::fabs(sum - exact), 1e-12) << N;
        }
    }
    for (int i = 0; i + 1 < N; ++i) EXPECT_LT(kRule.node(i), kRule.node(i + 1));
    EXPECT_GT(kRule.node(0), 0);
    EXPECT_LT(kRule.node(N - 1), 1);
}

TEST(GaussLegendreTest, IsExactForPolynomials) {
    expect_rule<1>();
    expect_rule<2>();
    expect_rule<5>();
    expect_rule<8>();
    expect_rule<20>();
    expect_rule<32>();
}

} // namespace
} // namespace nusselt_test
