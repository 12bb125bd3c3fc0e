#pragma once
/// What tests of techniques for emission that varies have in common: statistics of estimates, and lights that nobody sees.

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include <nusselt/core/vec.h>

namespace nusselt_test {

/// The mean of estimates over their integral, and their squared relative deviation.
struct Moments {
    double mean = 0, squares = 0;
    int points = 0; ///< shading points

    /// Adds the samples of a shading point. \param estimate function of random numbers
    template <class Estimate>
    void add(double integral, int samples, const Estimate& estimate) {
        std::mt19937 random(static_cast<unsigned>(points + 1));
        std::uniform_real_distribution<float> uniform(0, 0.9999999f);
        double sum = 0, sum_of_squares = 0;
        for (int k = 0; k < samples; ++k) {
            const float x = uniform(random);
            const double ratio = estimate(nusselt::Vec2<float>{x, uniform(random)}) / integral;
            sum += ratio - 1;
            sum_of_squares += (ratio - 1) * (ratio - 1);
        }
        mean += sum / samples;
        squares += sum_of_squares / samples;
        ++points;
    }
    double noise() const { return std::sqrt(squares / points); }
    double bias() const { return mean / points; }
};

/// Expects that a technique in float knows of nothing that it could sample.
template <class Technique>
void expect_dark(const Technique& technique) {
    EXPECT_EQ(technique.measure(), 0);
    EXPECT_EQ(technique.unshadowed().x, 0);
    EXPECT_EQ(technique.pdf({0, 0, 1}), 0);
    for (const float u : {0.0f, 0.5f, 0.99999994f}) {
        const auto s = technique.sample({u, u});
        EXPECT_EQ(s.pdf, 0);
        EXPECT_EQ(length(s.wi), 1);
        EXPECT_EQ(technique.invert(s.wi).x, 0);
    }
}

} // namespace nusselt_test
