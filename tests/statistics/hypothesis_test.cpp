/// Tests of the statistical tests: they give the p-values of tables, accept uniform samples and reject others.

#include "hypothesis.h"

#include <limits>

#include <gtest/gtest.h>

namespace nusselt_test {
namespace {

TEST(HypothesisTest, ChiSquareValuesFromTables) {
    EXPECT_NEAR(chi_square_p_value(3.841459, 1), 0.05, 1e-6);
    EXPECT_NEAR(chi_square_p_value(18.307038, 10), 0.05, 1e-6);
    EXPECT_NEAR(chi_square_p_value(3.940299, 10), 0.95, 1e-6);
    EXPECT_NEAR(chi_square_p_value(124.342113, 100), 0.05, 1e-6);
    EXPECT_NEAR(chi_square_p_value(149.449, 100), 0.001, 1e-6);
    EXPECT_EQ(chi_square_p_value(0, 5), 1);
}

TEST(HypothesisTest, ChiSquareComparesCounts) {
    EXPECT_NEAR(chi_square_test({50, 50}, {60, 40}), chi_square_p_value(4, 1), 1e-12);
    // The last two cells are pooled.
    EXPECT_NEAR(chi_square_test({50, 41, 5, 5}, {60, 31, 10, 0}), chi_square_p_value(4.0 / 2 + 100.0 / 41, 2),
                1e-12);
    EXPECT_EQ(chi_square_test({50, 50, 1e-9}, {30, 30, 40}), 0);
    // A single sample is too many where there must be none, even beside others that would be pooled.
    EXPECT_GT(chi_square_test({50, 50, 0, 20}, {50, 49, 0, 21}), 0.9);
    EXPECT_EQ(chi_square_test({50, 50, 0, 20}, {50, 49, 1, 20}), 0);
    EXPECT_GT(chi_square_test({50, 50, 1e-9, 20}, {50, 49, 1, 20}), 0.9);
}

TEST(HypothesisTest, KolmogorovSmirnov) {
    UniformFloats random(1);
    std::vector<double> uniform(20'000);
    for (double& x : uniform) x = random();
    EXPECT_GT(kolmogorov_smirnov_test(uniform), 0.01);
    // The critical value for 5 % is 1.3581 / sqrt(n).
    std::vector<double> shifted;
    for (int i = 0; i < 10'000; ++i) shifted.push_back((i + 0.5) / 10'000 + 0.013581 - 0.5 / 10'000);
    EXPECT_NEAR(kolmogorov_smirnov_test(shifted), 0.05, 1e-3);
    for (double& x : uniform) x *= x;
    EXPECT_LT(kolmogorov_smirnov_test(uniform), 1e-10);
}

TEST(HypothesisTest, StudentValuesFromTables) {
    EXPECT_NEAR(student_t_p_value(4.302653, 2), 0.05, 1e-6);
    EXPECT_NEAR(student_t_p_value(-2.119905, 16), 0.05, 1e-6);
    EXPECT_NEAR(student_t_p_value(4.014996, 16), 0.001, 1e-6);
    EXPECT_EQ(student_t_p_value(0, 16), 1);
}

TEST(HypothesisTest, StudentComparesMeans) {
    // Mean 2, standard error 1 / sqrt(3).
    EXPECT_NEAR(student_t_test({1, 2, 3}, 1, 0), student_t_p_value(std::sqrt(3), 2), 1e-12);
    EXPECT_NEAR(student_t_test({1, 2, 3}, 1, 0.25), student_t_p_value(0.75 * std::sqrt(3), 2), 1e-12);
    EXPECT_EQ(student_t_test({1, 2, 3}, 2.2, 0.25), 1);
    EXPECT_EQ(student_t_test({1, 1, 1}, 2, 0.25), 0);
}

TEST(HypothesisTest, CorrectsForTheNumberOfTests) {
    EXPECT_TRUE(reject({0.5, 0.0004, 0.9}) == false);
    EXPECT_TRUE(reject({0.5, 0.0003, 0.9}));
    EXPECT_TRUE(reject({0.0009}));
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(reject({kNaN, 0.5}) && reject({0.5, kNaN})) << "an infinite estimate is accepted";
    EXPECT_TRUE(reject({})) << "a test without samples is accepted";
    int tests = 0;
    const auto counted = [&](double p) {
        ++tests;
        return p;
    };
    EXPECT_TRUE(reject(std::vector{0.5, 0.0003, 0.9}, counted));
    EXPECT_EQ(tests, 2) << "the second one decides";
    EXPECT_FALSE(reject(std::vector{0.5, 0.0004, 0.9}, counted));
    EXPECT_EQ(tests, 5);
}

} // namespace
} // namespace nusselt_test
