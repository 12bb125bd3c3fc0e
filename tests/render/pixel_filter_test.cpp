/// Pixel filters: what pixels at the corner of a bright area are in expectation, and how much they vary.

#include "scenes.h"

#include "render/pixel_filter.h"
#include "render_cpu/kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace nusselt::render_test {
namespace {

using scene::FilterKind;
using scene::PixelFilter;

constexpr int kSize = 8;
/// The corner of the bright area, which extends to the right and downwards [pixels].
constexpr double kCornerX = 3.7;
constexpr double kCornerY = 4.2;

/// Parallel rays on a black plane of which a quadrant shines with radiance 1.
scene::Scene make_corner(const PixelFilter& filter, double corner_x, double corner_y) {
    scene::Scene scene;
    scene.materials.emplace_back();
    scene.materials[0].diffuse = {0, 0, 0};
    const auto x = static_cast<float>(corner_x);
    const auto y = static_cast<float>(corner_y);
    add_polygon_light(scene, {Float3{x, -20, 0}, Float3{20, -20, 0}, Float3{20, -y, 0}, Float3{x, -y, 0}},
                      {1, 1, 1}, false, 0);
    scene.camera.origin = {0, 0, 1};
    scene.camera.origin_right = {1, 0, 0};
    scene.camera.origin_down = {0, -1, 0};
    scene.camera.corner = {0, 0, -1};
    scene.camera.right = {0, 0, 0};
    scene.camera.down = {0, 0, 0};
    scene.film.width = scene.film.height = kSize;
    scene.film.filter = filter;
    set_radius(scene);
    return scene;
}

/// The filters as pbrt defines them, along one axis.
double value(const PixelFilter& filter, double radius, double x) {
    x = std::fabs(x);
    if (x > radius) return 0;
    switch (filter.kind) {
    case FilterKind::box:
        return 1;
    case FilterKind::triangle:
        return radius - x;
    case FilterKind::gaussian: {
        const auto bell = [&](double t) {
            return std::exp(-t * t / (2.0 * filter.sigma * filter.sigma)) /
                   std::sqrt(2 * 3.14159265358979 * filter.sigma * filter.sigma);
        };
        return std::max(0.0, bell(x) - bell(radius));
    }
    case FilterKind::mitchell: {
        const double t = 2 * x / radius;
        const double b = filter.b;
        const double c = filter.c;
        if (t > 1)
            return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t +
                    (8 * b + 24 * c)) /
                   6;
        return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + (6 - 2 * b)) / 6;
    }
    }
    return 0;
}

/// Midpoint rule from a lower bound to the radius.
double integral(const std::function<double(double)>& f, double begin, double radius) {
    constexpr int kSteps = 20000;
    begin = std::max(begin, -radius);
    if (begin >= radius) return 0;
    const double step = (radius - begin) / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += f(begin + (i + 0.5) * step) * step;
    return sum;
}

/// The share of a filter's weight to the right of an edge, at a distance from its centre.
double share_beyond(const std::function<double(double)>& f, double distance, double radius) {
    return integral(f, distance, radius) / integral(f, -radius, radius);
}

using AxisFunction = std::function<double(double radius, double x)>;

std::vector<double> expected_pixels(const PixelFilter& filter, const AxisFunction& f) {
    std::vector<double> pixels;
    const auto along = [&](double radius) { return [&f, radius](double x) { return f(radius, x); }; };
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            pixels.push_back(share_beyond(along(filter.radius_x), kCornerX - (x + 0.5), filter.radius_x) *
                             share_beyond(along(filter.radius_y), kCornerY - (y + 0.5), filter.radius_y));
    return pixels;
}

render::RenderSettings make_settings(int samples, render::SampleOrder order) {
    render::RenderSettings settings;
    settings.samples = samples;
    settings.sample_order = order;
    return settings;
}

/// Red of each pixel, one row per seed.
std::vector<std::vector<double>> rows_of(const scene::Scene& scene, render::RenderSettings settings,
                                         int seeds) {
    const render_cpu::Renderer renderer(scene, 2);
    std::vector<std::vector<double>> rows;
    for (int seed = 0; seed < seeds; ++seed) {
        settings.seed = static_cast<std::uint32_t>(seed);
        const image::Image image = renderer.render(settings, base::choose_isa()).image;
        std::vector<double>& row = rows.emplace_back();
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) row.push_back(image.pixels[i]);
    }
    return rows;
}

double mean_variance(const std::vector<std::vector<double>>& rows) {
    double sum = 0;
    const auto count = static_cast<double>(rows.size());
    for (std::size_t i = 0; i < rows[0].size(); ++i) {
        double mean = 0;
        for (const auto& row : rows) mean += row[i] / count;
        for (const auto& row : rows) sum += (row[i] - mean) * (row[i] - mean) / (count - 1);
    }
    return sum / static_cast<double>(rows[0].size());
}

struct Case {
    const char* name;
    PixelFilter filter;
};

class Filters : public testing::TestWithParam<Case> {
protected:
    const PixelFilter& filter() const { return GetParam().filter; }
    AxisFunction axis_function() const {
        return [this](double radius, double x) { return value(filter(), radius, x); };
    }
    AxisFunction magnitude_function() const {
        return [this](double radius, double x) { return std::fabs(value(filter(), radius, x)); };
    }
    /// The largest deviation of the mean of many samples from the convolution with a filter, in standard deviations:
    /// the mean square of a sample is the square of its weight times the probability of the bright area.
    double largest_deviation(const AxisFunction& f) const {
        constexpr int kSamples = 512;
        constexpr int kImages = 64;
        const auto rows = rows_of(make_corner(filter(), kCornerX, kCornerY),
                                  make_settings(kSamples, render::SampleOrder::independent), kImages);
        const std::vector<double> expected = expected_pixels(filter(), f);
        const std::vector<double> probability = expected_pixels(filter(), magnitude_function());
        const double weight = axis_weight(filter().radius_x) * axis_weight(filter().radius_y);
        double largest = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            double mean = 0;
            for (const auto& row : rows) mean += row[i] / kImages;
            // The filter is constant in each cell of its table.
            const double excess = std::fabs(mean - expected[i]) - 3e-5;
            const double mean_square = weight * weight * std::max(probability[i], 1e-9);
            largest = std::max(largest, excess / std::sqrt(mean_square / (kSamples * kImages)));
        }
        return largest;
    }
    /// Exceeded with a probability below 1e-3 in all tests of this file together.
    static constexpr double kLargestDeviation = 5;

    /// Integral of the absolute value over that of the filter.
    double axis_weight(double radius) const {
        const auto f = [&](double x) { return value(filter(), radius, x); };
        return integral([&](double x) { return std::fabs(f(x)); }, -radius, radius) /
               integral(f, -radius, radius);
    }
};

TEST_P(Filters, PixelsAreConvolutionsInExpectation) {
    EXPECT_LT(largest_deviation(axis_function()), kLargestDeviation);
}

class SignedFilters : public Filters {};

/// Samples in the negative lobes without their sign would be those of the absolute value.
TEST_P(SignedFilters, TheTestTellsForgottenSigns) {
    EXPECT_GT(largest_deviation(magnitude_function()), 2 * kLargestDeviation);
}

/// On a constant only the signs of weights vary: the mean square weight is known. Without negative lobes all is exact.
TEST_P(Filters, VaryBySignsAlone) {
    const auto rows =
        rows_of(make_corner(filter(), -10, -10), make_settings(1, render::SampleOrder::independent), 256);
    const double weight = axis_weight(filter().radius_x) * axis_weight(filter().radius_y);
    const double expected = weight * weight - 1;
    if (filter().kind == FilterKind::mitchell)
        EXPECT_NEAR(mean_variance(rows), expected, 0.1 * expected);
    else
        for (const auto& row : rows)
            for (const double pixel : row) ASSERT_EQ(pixel, 1);
}

/// A monotone map keeps Sobol' points stratified.
TEST_P(Filters, StayStratified) {
    const scene::Scene scene = make_corner(filter(), kCornerX, kCornerY);
    const double independent =
        mean_variance(rows_of(scene, make_settings(256, render::SampleOrder::independent), 16));
    const double sobol = mean_variance(rows_of(scene, make_settings(256, render::SampleOrder::sobol), 16));
    EXPECT_LT(sobol, 0.1 * independent);
}

TEST_P(Filters, DoNotMoveRaysThroughPixelCentres) {
    render::RenderSettings settings = make_settings(1, render::SampleOrder::sobol);
    settings.pixel_position = render::PixelPosition::center;
    for (const auto& row : rows_of(make_corner(filter(), kCornerX, kCornerY), settings, 1))
        for (int i = 0; i < kSize * kSize; ++i)
            EXPECT_EQ(row[static_cast<std::size_t>(i)],
                      i % kSize + 0.5 > kCornerX && i / kSize + 0.5 > kCornerY ? 1 : 0);
}

std::string name_of(const testing::TestParamInfo<Case>& test) { return test.param.name; }

constexpr Case kMitchell = {"mitchell", {FilterKind::mitchell, 2, 2}};
constexpr Case kSharpMitchell = {"sharp_mitchell", {FilterKind::mitchell, 2.5f, 1.5f, 0.5f, 0, 0.75f}};

INSTANTIATE_TEST_SUITE_P(Kinds, SignedFilters, testing::Values(kMitchell, kSharpMitchell), name_of);
INSTANTIATE_TEST_SUITE_P(Kinds, Filters,
                         testing::Values(Case{"box", {FilterKind::box, 0.5f, 0.5f}},
                                         Case{"wide_box", {FilterKind::box, 1.5f, 0.75f}},
                                         Case{"triangle", {FilterKind::triangle, 2, 1}},
                                         Case{"gaussian", {FilterKind::gaussian, 1.5f, 2, 0.5f}},
                                         Case{"wide_gaussian", {FilterKind::gaussian, 2, 1, 3.0f}}, kMitchell,
                                         kSharpMitchell),
                         name_of);

/// Narrow Gaussians and nearly flat ones are no special cases; what has no integral is an error.
TEST(FilterTables, CoverAllParameters) {
    for (const float sigma : {1e-4f, 1e-2f, 1e2f, 1e6f}) {
        const auto table = render::make_filter_table({FilterKind::gaussian, 2, 2, sigma}, 2);
        // The median of the distance: of a Gaussian, or of the parabola that its top is.
        const double expected = sigma < 1 ? 0.67449 * sigma : 2 * 0.347296;
        const auto& cumulative = table.cumulative;
        const auto above = std::upper_bound(cumulative.begin(), cumulative.end(), 0.75f);
        const double cell =
            static_cast<double>(above - cumulative.begin()) - 1 + (0.75 - above[-1]) / (above[0] - above[-1]);
        EXPECT_NEAR(table.reach * (2 * cell / render::kFilterCells - 1), expected, 1e-3 * expected);
        for (const float weight : table.weights) EXPECT_EQ(weight, 1);
    }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(render::make_filter_table({FilterKind::gaussian, 2, 2, 0}, 2), std::runtime_error);
    EXPECT_THROW(render::make_filter_table({FilterKind::triangle, 2, 2}, 0), std::runtime_error);
    EXPECT_THROW(render::make_filter_table({FilterKind::mitchell, 2, 2, 0.5f, nan, 0}, 2),
                 std::runtime_error);
}

} // namespace
} // namespace nusselt::render_test
