#include "common/source_folder.h"
#include "lab/errors/noise_curve.h"

#include "lab/report/plot.h"
#include "render/film.h"
#include "scene/import/importers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <random>
#include <stdexcept>

namespace nusselt::lab {

namespace {

/// A curve of standard deviations N^order with errors of some percent, as few seeds leave them.
NoiseCurve synthetic_curve(double order, double noise) {
    std::mt19937 generator(1);
    std::normal_distribution<double> error(0, noise);
    NoiseCurve curve;
    for (int n = 4; n <= 1024; n *= 2) {
        const double deviation = 0.3 * std::pow(n, order) * std::exp(error(generator));
        curve.push_back({n, deviation * deviation, 1e-3 * n});
    }
    return curve;
}

TEST(NoiseCurve, FindsTheOrder) {
    for (const double order : {-0.5, -0.75, -1.0, -1.5}) {
        EXPECT_NEAR(fitted_order(synthetic_curve(order, 0), 4, 1024), order, 1e-12);
        EXPECT_NEAR(fitted_order(synthetic_curve(order, 0.02), 4, 1024), order, 0.02);
    }
}

TEST(NoiseCurve, FitsInTheGivenRangeOnly) {
    NoiseCurve curve = synthetic_curve(-1, 0);
    curve.front().variance *= 100;
    EXPECT_NEAR(fitted_order(curve, 8, 1024), -1, 1e-12);
    EXPECT_LT(fitted_order(curve, 4, 1024), -1.1);
}

TEST(NoiseCurve, WithoutNoiseHasNoFiniteOrder) {
    NoiseCurve curve = synthetic_curve(-1, 0);
    curve[3].variance = 0;
    EXPECT_EQ(fitted_order(curve, 4, 1024), -std::numeric_limits<double>::infinity());
}

TEST(NoiseCurve, PowerLawsNeedTwoAbscissae) {
    EXPECT_THROW(fit_power_law({2, 2}, {1, 3}), std::invalid_argument);
    EXPECT_THROW(fit_power_law({}, {}), std::invalid_argument);
    EXPECT_NEAR(fit_power_law({1, 10}, {3, 300}).factor, 3, 1e-12);
}

TEST(NoiseCurve, InterpolatesTimes) {
    const NoiseCurve curve = synthetic_curve(-0.75, 0);
    for (const double n : {2.0, 4.0, 5.5, 100.0, 5000.0})
        EXPECT_NEAR(seconds_to_variance(curve, std::pow(0.3 * std::pow(n, -0.75), 2)), 1e-3 * n, 1e-9 * n);
    EXPECT_THROW(seconds_to_variance({{1, 1, 1}}, 1), std::invalid_argument);
}

class RenderSeeds : public testing::Test {
protected:
    RenderSeeds()
        : scene_(
              scene::load_scene(std::filesystem::path(nusselt_test::kSourceFolder) / "scenes/planes.pbrt")) {
        render::resize_film(scene_, 48, 36);
        settings_.technique = render::Technique::area;
        settings_.sample_order = render::SampleOrder::independent;
        settings_.pixel_position = render::PixelPosition::center;
    }

    scene::Scene scene_;
    render::RenderSettings settings_;
};

// Independent samples have the order -1/2, and one pixel's variance is that of its samples over their number.
TEST_F(RenderSeeds, MeasuresTheNoiseOfIndependentSamples) {
    const render_cpu::Renderer renderer(scene_, 2);
    NoiseCurve curve;
    for (const int n : {4, 16, 64}) {
        const SeedStatistics s = render_seeds(renderer, base::choose_isa(), with_count(settings_, n), 8);
        curve.push_back({n, s.variance, s.seconds});
        EXPECT_GT(s.seconds, 0);
    }
    EXPECT_NEAR(fitted_order(curve, 4, 64), -0.5, 0.04);
}

// The standard error describes how much the variances of other seeds differ.
TEST_F(RenderSeeds, StandardErrorsOfTheVarianceAreThoseOfOtherSeeds) {
    const render_cpu::Renderer renderer(scene_, 2);
    constexpr int kGroups = 32;
    constexpr int kSeeds = 8;
    std::vector<double> variances;
    double squared_errors = 0;
    for (int i = 0; i < kGroups; ++i) {
        settings_.seed = static_cast<std::uint32_t>(i * kSeeds);
        const SeedStatistics s = render_seeds(renderer, base::choose_isa(), settings_, kSeeds);
        variances.push_back(s.variance);
        squared_errors += s.variance_error * s.variance_error / kGroups;
    }
    double mean = 0, square = 0;
    for (const double v : variances) mean += v / kGroups;
    for (const double v : variances) square += (v - mean) * (v - mean) / (kGroups - 1);
    EXPECT_GT(squared_errors, 0.4 * square);
    EXPECT_LT(squared_errors, 2.5 * square);
}

// The mutant: one seed for all images would make noise vanish.
TEST_F(RenderSeeds, SeedsDiffer) {
    const render_cpu::Renderer renderer(scene_, 2);
    const auto isa = base::choose_isa();
    const SeedStatistics s = render_seeds(renderer, isa, settings_, 2);
    EXPECT_GT(s.variance, 0);
    const image::Image first = renderer.render(settings_, isa).image;
    settings_.seed = 1;
    const image::Image second = renderer.render(settings_, isa).image;
    double sum = 0;
    for (std::size_t i = 0; i < first.pixels.size(); ++i) {
        const double difference =
            static_cast<double>(first.pixels[i]) - static_cast<double>(second.pixels[i]);
        sum += difference * difference / 2;
        EXPECT_FLOAT_EQ(s.mean.pixels[i], 0.5f * (first.pixels[i] + second.pixels[i]));
    }
    EXPECT_NEAR(s.variance, sum / static_cast<double>(first.pixels.size()), 1e-6 * s.variance);
}

PlotPoint point(double x, double y) { return {x, y, y, y}; }

TEST(Plot, DrawsEachCurveAndLeavesOutWhatHasNoLogarithm) {
    const Plot plot = {"a < b",
                       "file",
                       "x",
                       "y",
                       {{"one", {point(1, 1), point(10, 0.1), point(100, 0)}},
                        {"two", {point(1, 2), point(100, 0.02)}, Stroke::dashed}}};
    const std::string svg = to_svg(plot);
    EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
    EXPECT_NE(svg.find(">one<"), std::string::npos);
    EXPECT_NE(svg.find("stroke-dasharray"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    // Parallel lines in logarithmic axes: both fall by two decades over two, as far as they go.
    const auto points_of = [&](std::size_t from) {
        const std::size_t begin = svg.find("points=\"", from) + 9;
        return svg.substr(begin, svg.find('"', begin) - begin);
    };
    double x[4], y[4];
    const std::size_t first = svg.find("<polyline");
    ASSERT_EQ(std::sscanf(points_of(first).c_str(), "%lf,%lf %lf,%lf", &x[0], &y[0], &x[1], &y[1]), 4);
    const std::size_t second = svg.find("<polyline", first + 1);
    ASSERT_EQ(std::sscanf(points_of(second).c_str(), "%lf,%lf %lf,%lf", &x[2], &y[2], &x[3], &y[3]), 4);
    EXPECT_NEAR(x[3] - x[2], 2 * (x[1] - x[0]), 0.21);
    EXPECT_NEAR(y[3] - y[2], 2 * (y[1] - y[0]), 0.21);
    EXPECT_GT(y[1], y[0]);
}

TEST(Plot, OfNothingIsAFrame) {
    const std::string svg = to_svg({"", "file", "x", "y", {{"empty", {}}}});
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

} // namespace

} // namespace nusselt::lab
