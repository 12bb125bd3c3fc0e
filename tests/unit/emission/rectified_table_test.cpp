/// Tests of tables of radiance by direction and of their windows.

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "emission/windowed_lights.h"

namespace nusselt_test {
namespace {

using nusselt::RectifiedDomain;
using nusselt::RectifiedSums;
using nusselt::RectifiedTable;
using nusselt::TableAxis;
using nusselt::TableWindow;
using nusselt::Vec2;
using Vector = nusselt::Vec3<double>;

constexpr double kWhole = 4503599627370496.0; // 2^52

TexelMap random_map(int size) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    return TexelMap(size, [&](const Vector&) { return std::pow(uniform(random), 6); });
}

/// The integral over a texel by many points.
double solid_angle_of(const TexelMap& map, int i, int j) {
    constexpr int kSteps = 64;
    const double step = nusselt::kPi<double> / map.size / kSteps;
    double sum = 0;
    for (int l = 0; l < kSteps; ++l)
        for (int k = 0; k < kSteps; ++k) {
            const Vector w = map.direction_at(i + (k + 0.5) / kSteps, j + (l + 0.5) / kSteps);
            sum += (1 - w.x * w.x) * (1 - w.y * w.y) / w.z;
        }
    return sum * step * step;
}

TEST(RectifiedTable, TexelsWeighTheirExactSolidAngle) {
    const TexelMap map(32, [](const Vector&) { return 1; });
    const auto stored = table_of<double>(map);
    const RectifiedSums all = stored.table.sum(0, 32, 0, 32);
    EXPECT_NEAR(static_cast<double>(all.solid_angle) / kWhole, 1, 1e-12);
    EXPECT_NEAR(static_cast<double>(all.weight) / kWhole, 1, 1e-12);
    EXPECT_NEAR(stored.table.mean, 1, 1e-12);
    EXPECT_NEAR(stored.table.mean_square, 1, 1e-12);
    EXPECT_NEAR(stored.colour.back().y, 2 * nusselt::kPi<double>, 1e-8);
    for (const auto& texel : {Vec2<int>{16, 16}, {3, 20}, {10, 1}, {0, 15}}) {
        const double share =
            static_cast<double>(stored.table.sum(texel.x, texel.x + 1, texel.y, texel.y + 1).solid_angle) /
            kWhole;
        EXPECT_NEAR(2 * nusselt::kPi<double> * share / solid_angle_of(map, texel.x, texel.y), 1, 1e-3)
            << texel.x;
    }
}

/// Domains from most of the hemisphere to a millionth of a degree: texels add up, and are alike in small ones.
TEST(RectifiedTable, DomainsOfAllSizesAreCovered) {
    for (const double size : {100.0, 1.0, 1e-3, 1e-6, 1e-8, 1e-12}) {
        const Vec2<double> centre{0.3, -0.2};
        const RectifiedDomain<double> domain{{centre.x - size, centre.y - size},
                                             {centre.x + size, centre.y + size}};
        const StoredTable<double> stored([](const auto&) { return grey<double>(2); }, domain, 16, 16, 1);
        const double all = static_cast<double>(stored.table.sum(0, 16, 0, 16).solid_angle) / kWhole;
        EXPECT_NEAR(all, 1, 1e-6) << size;
        EXPECT_NEAR(stored.table.mean, 2, 1e-5) << size;
        if (size > 0.1) continue;
        const auto texel = stored.table.sum(3, 4, 5, 6);
        EXPECT_NEAR(static_cast<double>(texel.solid_angle) * 256 / kWhole, 1, size < 1e-2 ? 2e-3 : 0.3)
            << size;
        EXPECT_NEAR(static_cast<double>(texel.weight) / static_cast<double>(texel.solid_angle) * all, 1,
                    1e-4);
    }
}

/// Differences of sums over rectangles are sums over their texels, to the last unit, next to the sun and far from it.
TEST(RectifiedTable, DifferencesAreExact) {
    TexelMap map(200,
                 [](const Vector& w) { return w.x > 0.9 ? 0 : 1 + (w.y > 0.7 && w.y < 0.71 ? 1e6 : 0); });
    const auto stored = table_of<float>(map);
    std::vector<RectifiedSums> texels;
    for (int j = 0; j < 200; ++j)
        for (int i = 0; i < 200; ++i) texels.push_back(stored.table.sum(i, i + 1, j, j + 1));
    std::mt19937 random(1);
    for (int k = 0; k < 300; ++k) {
        std::uniform_int_distribution<int> first(0, 180), count(0, 20);
        const int i = first(random), j = first(random), columns = count(random), rows = count(random);
        RectifiedSums expected{0, 0, 0};
        for (int row = j; row < j + rows; ++row)
            for (int column = i; column < i + columns; ++column) {
                const RectifiedSums& texel = texels[static_cast<std::size_t>(row * 200 + column)];
                ASSERT_GE(texel.weight, 0);
                ASSERT_EQ(texel.weight > 0, texel.square > 0);
                ASSERT_GT(texel.solid_angle, 0);
                expected.weight += texel.weight;
                expected.square += texel.square;
                expected.solid_angle += texel.solid_angle;
            }
        const RectifiedSums sum = stored.table.sum(i, i + columns, j, j + rows);
        ASSERT_EQ(sum.weight, expected.weight);
        ASSERT_EQ(sum.square, expected.square);
        ASSERT_EQ(sum.solid_angle, expected.solid_angle);
    }
}

/// A lit texel keeps a weight next to one of 1e30, and lookups that miss a light have a neighbour that saw it.
TEST(RectifiedTable, NoLitTexelIsLost) {
    TexelMap map(64, [](const Vector& w) { return dot(w, Vector{0.6, 0, 0.8}) > 0.9995 ? 1e30 : 1e-6; });
    const auto stored = table_of<float>(map);
    int huge = 0;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) {
            ASSERT_GT(stored.table.sum(i, i + 1, j, j + 1).weight, 0);
            huge += map.at_texel(i, j) > 1;
        }
    EXPECT_GT(huge, 0);
    EXPECT_GT(stored.table.mean_square, 100);
    EXPECT_TRUE(std::isfinite(stored.table.mean) && std::isfinite(stored.table.mean_square));

    // A light in one corner of a texel, which the lookup of the other texels at this corner misses.
    TexelMap spot(16, [](const Vector&) { return 0; });
    const Vector corner = spot.direction_at(8.45, 8.45);
    const StoredTable<double> seen(
        [&](const Vector& w) { return grey<double>(dot(w, corner) > 0.998 ? 1 : 0); },
        RectifiedDomain<double>::hemisphere(), 16, 16, 1);
    const auto weight = [&](int i, int j) { return seen.table.sum(i, i + 1, j, j + 1).weight; };
    EXPECT_GT(weight(8, 8), 1000 * weight(7, 7) / 2);
    EXPECT_GT(weight(7, 7), 0);
    EXPECT_GT(weight(9, 9), 0);
    EXPECT_EQ(weight(6, 6), 0);
}

TEST(RectifiedTable, RadianceWithoutMeaningIsBlackOrLargest) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const auto hemisphere = RectifiedDomain<float>::hemisphere();
    for (const float value : {0.0f, -1.0f, kNan}) {
        const StoredTable<float> stored([&](const auto&) { return grey<float>(static_cast<double>(value)); },
                                        hemisphere, 8, 4, 2);
        EXPECT_EQ(stored.table.mean, 0);
        EXPECT_EQ(stored.table.mean_square, 0);
        EXPECT_EQ(stored.table.sum(0, 8, 0, 4).weight, 0);
    }
    const StoredTable<float> stored(
        [&](const auto& w) { return grey<float>(w.x > 0 ? static_cast<double>(kInfinity) : 1); }, hemisphere,
        8, 4, 2);
    EXPECT_TRUE(std::isfinite(stored.table.mean));
    EXPECT_TRUE(std::isfinite(stored.colour.back().x));
    EXPECT_EQ(stored.table.sum(4, 8, 0, 4).weight > stored.table.sum(0, 4, 0, 4).weight, true);
    // One texel is a table.
    const StoredTable<double> single([](const auto&) { return grey<double>(3); },
                                     RectifiedDomain<double>::hemisphere(), 1, 1, 4);
    EXPECT_NEAR(single.table.mean, 3, 1e-12);
}

struct Window {
    double begin_x, end_x, begin_y, end_y; // texels
};

const std::vector<Window>& windows() {
    // Inside of a texel, across one line, over many, at the edges, thin as a needle.
    static const std::vector<Window> list = {
        {5.2, 5.7, 3.1, 3.2},  {5.6, 6.3, 7.5, 8.25},   {2.25, 13.5, 4.5, 11.75},
        {0, 16, 0, 16},        {3, 9, 4, 12},           {7.001, 7.002, 0.5, 15.5},
        {0.25, 15.9, 9, 9.25}, {12.5, 16, 0.0, 0.0625}, {1e-3, 15.999, 8 - 1e-6, 8 + 1e-6}};
    return list;
}

/// A window with its origin somewhere else.
template <class T>
TableWindow<T> window_in(const RectifiedTable<T>& table, const Window& w, double origin_x, double origin_y) {
    const TableAxis<T> across(table.width, static_cast<T>(origin_x));
    const TableAxis<T> along(table.height, static_cast<T>(origin_y));
    return {table, across, along,
            across.interval(static_cast<T>(w.begin_x - origin_x), static_cast<T>(w.end_x - origin_x)),
            along.interval(static_cast<T>(w.begin_y - origin_y), static_cast<T>(w.end_y - origin_y))};
}

double overlap(double begin, double end, int i) {
    return std::max(std::min(end, i + 1.0) - std::max(begin, 1.0 * i), 0.0);
}

TEST(TableWindow, SumsHaveTheSharesOfTexels) {
    const TexelMap map = random_map(16);
    const auto stored = table_of<double>(map);
    for (const Window& w : windows()) {
        double weight = 0, square = 0, solid_angle = 0;
        for (int j = 0; j < 16; ++j)
            for (int i = 0; i < 16; ++i) {
                const RectifiedSums texel = stored.table.sum(i, i + 1, j, j + 1);
                const double share = overlap(w.begin_x, w.end_x, i) * overlap(w.begin_y, w.end_y, j) / kWhole;
                weight += share * static_cast<double>(texel.weight);
                square += share * static_cast<double>(texel.square);
                solid_angle += share * static_cast<double>(texel.solid_angle);
            }
        for (const double origin : {0.0, 6.4, 16.0}) {
            const auto window = window_in(stored.table, w, origin, origin);
            const auto sums = window.sums();
            ASSERT_NEAR(sums.weight / weight, 1, 1e-7);
            ASSERT_NEAR(sums.square / square, 1, 1e-7);
            ASSERT_NEAR(sums.solid_angle / solid_angle, 1, 1e-7);
            const double variation = stored.table.mean_square * square * solid_angle / (weight * weight) - 1;
            ASSERT_NEAR(window.variation(), variation, 1e-6 * (1 + variation));
        }
    }
}

template <class T>
class TableWindowTest : public ::testing::Test {};
using Numbers = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TableWindowTest, Numbers);

/// The share of samples in each texel, and their uniformity there, follow from inversion: it undoes sampling, and its
/// derivative is the density.
TYPED_TEST(TableWindowTest, InversionUndoesSampling) {
    using T = TypeParam;
    const TexelMap map(
        16, [](const Vector& w) { return w.x > 0.4 ? 0 : 1 + 20 * w.y * w.y + (w.x < -0.2 ? 100 : 0); });
    const auto stored = table_of<T>(map);
    const double tolerance = std::is_same_v<T, float> ? 2e-3 : 1e-7;
    std::mt19937 random(2);
    std::uniform_real_distribution<T> uniform(0, T(0.9999999));
    for (const Window& w : windows()) {
        const auto window = window_in(stored.table, w, 8, 8);
        if (!(window.sums().weight > 0)) continue;
        for (int k = 0; k < 100; ++k) {
            const T x = uniform(random);
            const Vec2<T> u{x, uniform(random)};
            const auto point = window.sample(u);
            ASSERT_GE(point.offset.x, window.columns.begin);
            ASSERT_LE(point.offset.x, window.columns.end);
            ASSERT_GE(point.offset.y, window.rows.begin);
            ASSERT_LE(point.offset.y, window.rows.end);
            ASSERT_GT(stored.table.sum(point.i, point.i + 1, point.j, point.j + 1).weight, 0);
            const Vec2<T> inverse = window.invert(point.offset);
            ASSERT_NEAR(inverse.x, u.x, tolerance);
            ASSERT_NEAR(inverse.y, u.y, tolerance);
        }
    }
}

TEST(TableWindow, DensityIsTheDerivativeOfInversion) {
    const TexelMap map = random_map(16);
    const auto stored = table_of<double>(map);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const Window& w : windows()) {
        const auto window = window_in(stored.table, w, 8, 8);
        const double step_x = 1e-4 * (w.end_x - w.begin_x), step_y = 1e-4 * (w.end_y - w.begin_y);
        int count = 0;
        for (int k = 0; k < 100; ++k) {
            const double x = uniform(random);
            const auto point = window.sample({x, uniform(random)});
            const Vec2<double> next{point.offset.x + step_x, point.offset.y + step_y};
            const auto other = window.point_at(next);
            if (other.i != point.i || other.j != point.j || next.x > window.columns.end ||
                next.y > window.rows.end)
                continue;
            const Vec2<double> a = window.invert(point.offset), b = window.invert(next);
            ASSERT_NEAR((b.x - a.x) * (b.y - a.y) / (step_x * step_y) / window.pdf(point), 1, 1e-5);
            ++count;
        }
        EXPECT_GT(count, 50);
    }
}

TEST(TableWindow, LitPartIsTheBoundingBox) {
    const TexelMap map(32, [](const Vector&) { return 0; });
    const auto dark = table_of<double>(map);
    const auto none = window_in(dark.table, {0, 32, 0, 32}, 0, 0).lit();
    EXPECT_EQ(none.begin[0], none.end[0]);
    std::mt19937 random(8);
    std::uniform_int_distribution<int> texel(0, 31);
    for (int k = 0; k < 40; ++k) {
        std::vector<RectifiedSums> sums(33 * 33, RectifiedSums{0, 0, 0});
        const Vec2<int> spots[2] = {{texel(random), texel(random)}, {texel(random), texel(random)}};
        for (int j = 1; j <= 32; ++j)
            for (int i = 1; i <= 32; ++i)
                for (const auto& spot : spots)
                    if (spot.x < i && spot.y < j) ++sums[static_cast<std::size_t>(j * 33 + i)].weight;
        RectifiedTable<double> table = dark.table;
        table.sums = sums.data();
        const auto lit = window_in(table, {0, 32, 0, 32}, 0, 0).lit();
        EXPECT_EQ(lit.begin[0], std::min(spots[0].x, spots[1].x));
        EXPECT_EQ(lit.end[0], std::max(spots[0].x, spots[1].x) + 1);
        EXPECT_EQ(lit.begin[1], std::min(spots[0].y, spots[1].y));
        EXPECT_EQ(lit.end[1], std::max(spots[0].y, spots[1].y) + 1);
    }
}

} // namespace
} // namespace nusselt_test
