#include "lab/lines/line_efficiency.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nusselt::lab {

namespace {

/// Standard deviations 1 / n^order, times n ms times a factor.
NoiseCurve curve(int first, int last, double order, double milliseconds) {
    NoiseCurve result;
    for (int n = first; n <= last; n *= 2)
        result.push_back({n, std::pow(n, -2 * order), 1e-3 * milliseconds * n});
    return result;
}

// n lines have the error of n^1.5 points and cost three times as much as n points: they win where 3 n < n^1.5, for more
// than 27 points.
LineEfficiency example(double choice_milliseconds) {
    return {curve(4, 1024, 0.8, 1), curve(1, 128, 1.2, 3), curve(1, 128, 1.2, choice_milliseconds), 1};
}

TEST(LineEfficiency, TimesToEqualErrorAreThoseOfPowerLaws) {
    for (const EqualErrorRow& row : equal_error_rows(example(3))) {
        const double lines = std::pow(row.points, 2.0 / 3.0);
        EXPECT_NEAR(row.points_seconds, 1e-3 * row.points, 1e-12);
        EXPECT_NEAR(row.lines_seconds, 3e-3 * lines, 1e-9) << row.points;
        EXPECT_NEAR(row.lines_over_points(), 3 * lines / row.points, 1e-9) << row.points;
        EXPECT_FALSE(row.lines_are_extrapolated);
    }
    EXPECT_EQ(crossover(equal_error_rows(example(3))), 32);
}

TEST(LineEfficiency, LinesMustWinForAllLargerNumbers) {
    LineEfficiency efficiency = example(3);
    for (CurvePoint& point : efficiency.points)
        if (point.count == 64) point.seconds = 1e-3;
    EXPECT_EQ(crossover(equal_error_rows(efficiency)), 128);
    for (CurvePoint& point : efficiency.lines) point.seconds *= 100;
    EXPECT_FALSE(crossover(equal_error_rows(efficiency)));
}

TEST(LineEfficiency, LossIsAgainstTheBetterOne) {
    // Where points are better, the choice takes as long as lines do: 3 * 4^(2/3) to 4 ms for 4 points.
    EXPECT_NEAR(largest_loss(equal_error_rows(example(3))), 3 * std::pow(4, -1.0 / 3.0), 1e-9);
    EXPECT_NEAR(largest_loss(equal_error_rows(example(6))), 6 * std::pow(4, -1.0 / 3.0), 1e-9);
    EXPECT_LT(largest_loss(equal_error_rows(example(0.1))), 1);
}

TEST(LineEfficiency, ASingleLineIsTheLeast) {
    LineEfficiency efficiency = example(3);
    for (CurvePoint& point : efficiency.lines) point.variance *= 1e-3;
    const EqualErrorRow few_points = equal_error_rows(efficiency).front();
    EXPECT_EQ(few_points.lines_seconds, efficiency.lines.front().seconds);
}

TEST(LineEfficiency, SaysWhereLinesAreExtrapolated) {
    LineEfficiency efficiency = example(3);
    efficiency.lines = curve(1, 16, 1.2, 3); // as good as 64 points
    for (const EqualErrorRow& row : equal_error_rows(efficiency)) {
        // At 64, rounding decides.
        if (row.points != 64) {
            EXPECT_EQ(row.lines_are_extrapolated, row.points > 64) << row.points;
        }
        EXPECT_NEAR(row.lines_seconds, 3e-3 * std::pow(row.points, 2.0 / 3.0), 1e-9);
    }
}

TEST(LineEfficiency, ExtrapolationProvesNothing) {
    LineEfficiency efficiency = example(3);
    efficiency.lines = curve(1, 4, 1.2, 3); // as good as 8 points, where points win
    EXPECT_FALSE(crossover(equal_error_rows(efficiency)));
    efficiency = example(100);
    efficiency.choice.resize(1);                 // as good as one point
    efficiency.choice.push_back({2, 0.2, 1, 0}); // not even as good as four points
    for (const EqualErrorRow& row : equal_error_rows(efficiency))
        EXPECT_TRUE(row.choice_is_extrapolated) << row.points;
    EXPECT_EQ(largest_loss(equal_error_rows(efficiency)), 0);
}

TEST(LineEfficiency, GlossySurfacesKeepTheirDiffuseAlbedo) {
    scene::Scene scene;
    scene.materials.resize(2);
    scene.materials[1].diffuse = {0.1f, 0.2f, 0.3f};
    scene.materials[1].f0 = {0.9f, 0.8f, 0.7f};
    make_glossy(scene, 0.25f);
    for (const scene::Material& material : scene.materials) {
        EXPECT_EQ(material.model, scene::BrdfModel::frostbite);
        EXPECT_EQ(material.roughness, 0.25f);
        EXPECT_EQ(material.f0.x, 0.04f);
    }
    EXPECT_EQ(scene.materials[1].diffuse.y, 0.2f);
}

} // namespace

} // namespace nusselt::lab
