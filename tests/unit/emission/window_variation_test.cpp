/// Where samples of the measure alone take the place of those in proportion to radiance.

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/emission/spread.h>
#include <nusselt/emission/window_variation.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>

#include "emission/windowed_lights.h"

namespace nusselt_test {
namespace {

using nusselt::Frame;
using nusselt::kLittleVariation;
using nusselt::Vec2;
using nusselt::window_variation;
using nusselt::WindowedLight;
using nusselt::WindowPlane;
using Point = nusselt::Vec3<double>;
using Measure = nusselt::PolygonProjectedSolidAngle<double, 4>;
using Product = nusselt::WindowedPolygon<double, 8>;

/// A sky that grows brighter towards +y, with a sun of four degrees.
const TexelMap& sky_and_sun() {
    static const TexelMap map(180, [](const Point& w) {
        const bool is_sun = dot(w, normalize(Point{0.35, 0.45, 1})) > std::cos(nusselt::kPi<double> / 45);
        return 0.5 + 0.4 * w.y + (is_sun ? 100 : 0);
    });
    return map;
}

template <class T>
const nusselt::RectifiedTable<T>& sky_table() {
    static const StoredTable<T> stored = table_of<T>(sky_and_sun());
    return stored.table;
}

/// A window of 0.4 x 0.3 around the z axis, and points that see different parts of the sky through it.
template <class T>
WindowedLight<T> window() {
    return portal_of(rectangle_at<T>(0, T(-0.2), T(0.2), T(-0.15), T(0.15)), sky_table<T>());
}
template <class T>
WindowPlane<T> seen_from(const WindowedLight<T>& light, const nusselt::Vec3<T>& point) {
    return to_shading_space(light.plane, point, upright<T>());
}

constexpr Point kSeesSun{-0.35, -0.45, -1};
constexpr Point kSeesSky{0.4, 0.1, -0.9};

/// Over texels whose centres are in the box, which grows by two texels on all sides at most.
double variation_by_texels(const Point& point, double more) {
    const TexelMap& map = sky_and_sun();
    const double distance = -point.z;
    const double texel = nusselt::kPi<double> / map.size;
    const auto angle = [&](double x) { return std::atan2(x, distance); };
    const double left = angle(-0.2 - point.x), right = angle(0.2 - point.x);
    const double bottom = angle(-0.15 - point.y), top = angle(0.15 - point.y);
    double size = 0, sum = 0, squares = 0;
    for (int j = 0; j < map.size; ++j) {
        for (int i = 0; i < map.size; ++i) {
            const double a = map.angle_at(i + 0.5), b = map.angle_at(j + 0.5);
            if (a < left - more * texel || a > right + more * texel || b < bottom - more * texel ||
                b > top + more * texel)
                continue;
            const double p = std::tan(a), q = std::tan(b);
            const double weight = (1 + p * p) * (1 + q * q) / std::pow(1 + p * p + q * q, 1.5);
            size += weight;
            sum += weight * map.at_texel(i, j);
            squares += weight * map.at_texel(i, j) * map.at_texel(i, j);
        }
    }
    return size * squares / (sum * sum) - 1;
}

TEST(WindowVariation, IsThatOfTheTexelsInTheBox) {
    const auto light = window<double>();
    // Without the sun, a row more or less hardly matters.
    const double sky = window_variation(seen_from(light, kSeesSky), light);
    EXPECT_NEAR(sky, variation_by_texels(kSeesSky, 1), 0.1 * sky);
    EXPECT_GT(std::fabs(sky - variation_by_texels(kSeesSky + Point{0, 0, 0.2}, 1)), 0.1 * sky);
    // The texels next to the box count as well, so that all of it is seen.
    const double sun = window_variation(seen_from(light, kSeesSun), light);
    EXPECT_GT(sun, variation_by_texels(kSeesSun, 0));
    EXPECT_LT(sun, variation_by_texels(kSeesSun, 2));
    const auto single = window<float>();
    EXPECT_NEAR(window_variation(seen_from(single, {-0.35f, -0.45f, -1}), single), sun, 1e-3 * sun);
}

/// A portal that hides the sun by less than a texel: rounding and interpolation could still let it through.
TEST(WindowVariation, KnowsWhatIsNextToTheBox) {
    const auto light = window<double>();
    const double texel = nusselt::kPi<double> / sky_and_sun().size;
    const double slope = std::tan(std::atan(0.35) + nusselt::kPi<double> / 45 + 0.7 * texel);
    // The left edge of the window is right of the sun.
    const Point point{-0.2 - slope, -0.45, -1};
    EXPECT_LT(variation_by_texels(point, 0), kLittleVariation<double>);
    EXPECT_GT(window_variation(seen_from(light, point), light), kLittleVariation<double>);
}

TEST(WindowVariation, CountsWhatIsBeyondTheTableAsBlack) {
    const auto bright = [](const nusselt::Vec3<double>&) { return grey<double>(1); };
    const StoredTable<double> stored(bright, {{-0.5, -0.5}, {0.5, 0.5}}, 32, 32, 1);
    const auto vertices = rectangle_at<double>(0, -0.1, 0.1, -0.1, 0.1);
    const auto light = portal_of(vertices, stored.table);
    EXPECT_LT(window_variation(seen_from(light, {0, 0, -1}), light), 1e-6);
    EXPECT_LT(window_variation(seen_from(light, {0.4, -0.4, -1}), light), 1e-6);
    EXPECT_EQ(window_variation(seen_from(light, {0.45, 0, -1}), light),
              std::numeric_limits<double>::infinity());
    EXPECT_EQ(window_variation(seen_from(light, {0, -0.45, -1}), light),
              std::numeric_limits<double>::infinity());
    // Points that it does not light.
    EXPECT_EQ(window_variation(seen_from(light, {0, 0, 1}), light), 0);
    EXPECT_EQ(window_variation(seen_from(light, {0.3, 0, 0}), light), 0);
}

/// From next to a huge light, one of both ways to sample it has samples, whether or not the light falls to black within its table.
TEST(WindowVariation, LeavesHugeLightsToTheMeasure) {
    const StoredTable<float> wide(
        [](const auto& w) { return grey<float>(1 + 0.9 * static_cast<double>(w.x)); },
        nusselt::RectifiedDomain<float>::hemisphere(), 32, 32, 1);
    const nusselt::RadialSpread<float> spread{0.05f};
    const StoredTable<float> narrow(
        [&](const auto& w) { return grey<float>(static_cast<double>(spread.share(w))); }, spread.domain(), 32,
        32, 1);
    int by_cells = 0, by_measure = 0;
    for (const StoredTable<float>* const stored : {&wide, &narrow})
        for (const float size : {1e3f, 1e8f, 1e9f, 2e9f, 4e9f, 5e9f, 1e12f, 1e15f, 1e20f, 1e30f})
            for (const float height : {1e-3f, 1.0f, 0.1f * size}) {
                const auto light = portal_of(rectangle_at<float>(0, -size, size, -size, size), stored->table);
                const auto plane = seen_from(light, {0.1f, 0.2f, -height});
                const float variation = window_variation(plane, light);
                ASSERT_GE(variation, 0);
                const nusselt::WindowedPolygon<float, 8> cells(plane, light);
                const bool is_even = variation <= kLittleVariation<float>;
                EXPECT_TRUE(is_even || cells.measure() > 0) << size << " " << height;
                ++(is_even ? by_measure : by_cells);
                // Only where no cells can be found.
                EXPECT_EQ(is_even, size > 2e9f * height) << size << " " << height;
            }
    EXPECT_GT(by_cells, 20);
    EXPECT_GT(by_measure, 10);
}

TEST(WindowVariation, IsANumberForHostilePoints) {
    const auto light = window<float>();
    constexpr float kNumbers[] = {0, 1e-30f, -1e-30f, 1e-6f, -0.2f, 1, -1e6f, 1e15f, -1e15f};
    for (const float x : kNumbers)
        for (const float y : kNumbers)
            for (const float z : kNumbers) EXPECT_GE(window_variation(seen_from(light, {x, y, z}), light), 0);
    EXPECT_GE(window_variation(seen_from(light, {0, std::numeric_limits<float>::quiet_NaN(), -1}), light), 0);
}

/// Surfaces in random places and orientations behind the window, above whose horizon it is.
template <class Function>
void for_each_view(int views, const Function& f) {
    const auto light = window<double>();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < views;) {
        const Point point{0.5 * uniform(random) - 0.2, 0.5 * uniform(random) - 0.2,
                          -0.9 + 0.5 * uniform(random)};
        const auto frame = Frame<double>::from_normal(
            normalize(Point{uniform(random), uniform(random), 1.2 + uniform(random)}));
        const auto plane = to_shading_space(light.plane, point, frame);
        const auto polygon =
            nusselt::rectangle_in<double>({plane.corner, plane.frame.t, plane.frame.b, plane.frame.n},
                                          light.outline.vertex[0], light.outline.vertex[2]);
        bool is_above = true;
        for (const Point& v : polygon.vertex) is_above = is_above && v.z > 0;
        if (!is_above) continue;
        f(light, plane, polygon, frame);
        ++k;
    }
}

template <class Technique>
double estimate(const Technique& technique, const Frame<double>& frame, const Vec2<double>& u) {
    const auto s = technique.sample(u);
    return s.pdf > 0 ? sky_and_sun()(frame.to_world(s.wi)) * std::max(s.wi.z, 0.0) / s.pdf : 0;
}

TEST(WindowVariation, LittleMeansLittleNoise) {
    int even = 0;
    double noisiest = 0;
    double largest_elsewhere = 0;
    for_each_view(60, [&](const auto& light, const auto& plane, const auto& polygon, const auto& frame) {
        std::mt19937 random(9);
        std::uniform_real_distribution<double> uniform(0, 1);
        const Measure measure(polygon);
        Estimates estimates;
        for (int k = 0; k < 1000; ++k) {
            const double x = uniform(random);
            estimates.add(estimate(measure, frame, {x, uniform(random)}));
        }
        const bool is_even = window_variation(plane, light) <= kLittleVariation<double>;
        even += is_even ? 1 : 0;
        double& noise = is_even ? noisiest : largest_elsewhere;
        noise = std::max(noise, std::sqrt(estimates.relative_variance()));
    });
    EXPECT_GT(even, 10);
    EXPECT_LT(even, 50);
    EXPECT_LT(noisiest, 0.35);
    EXPECT_GT(largest_elsewhere, 3);
}

/// How far the mean over views of both ways of sampling is from that of the product alone, in standard deviations.
/// \param takes_measure(plane, light, what the measure would give)
template <class Rule>
double deviations_of(const Rule& takes_measure) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    double difference = 0;
    double variance = 0;
    for_each_view(100, [&](const auto& light, const auto& plane, const auto& polygon, const auto& frame) {
        const Measure measure(polygon);
        const Product product(plane, light);
        Estimates chosen, reference;
        for (int k = 0; k < 400; ++k) {
            const double x = uniform(random), y = uniform(random);
            const double of_measure = estimate(measure, frame, {x, y});
            chosen.add(takes_measure(plane, light, of_measure) ? of_measure
                                                               : estimate(product, frame, {x, y}));
            const double z = uniform(random);
            reference.add(estimate(product, frame, {z, uniform(random)}));
        }
        difference += chosen.mean() / reference.mean() - 1;
        variance += (chosen.relative_variance() + reference.relative_variance()) / chosen.count;
    });
    return difference / std::sqrt(variance);
}

TEST(WindowVariation, ChoosesWithoutBias) {
    EXPECT_LT(std::fabs(deviations_of([](const auto& plane, const auto& light, double) {
                  return window_variation(plane, light) <= kLittleVariation<double>;
              })),
              4);
    // The test of the test: a rule that takes the measure unless its sample meets the sun, so that it depends on random numbers.
    EXPECT_GT(
        std::fabs(deviations_of([](const auto&, const auto&, double of_measure) { return of_measure < 1; })),
        8);
}

} // namespace
} // namespace nusselt_test
