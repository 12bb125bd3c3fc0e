/// Tests of lights whose radiance depends on the direction, at the limits: nothing to see, needles, huge texels, hostile lights.

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/emission/spread.h>

#include "emission/estimates.h"
#include "emission/windowed_variants.h"

namespace nusselt_test {
namespace {

using nusselt::Frame;
using nusselt::LobeCells;
using nusselt::ProjectedCells;
using nusselt::Vec2;
using nusselt::WindowedLight;
using nusselt::WindowedPolygon;
using Vector = nusselt::Vec3<double>;

TEST(WindowedPolygon, NothingComesFromWhatCannotBeSeen) {
    const TexelMap black(16, [](const Vector&) { return 0; });
    const TexelMap white(16, [](const Vector&) { return 1; });
    const TexelMap left(16, [](const Vector& w) { return w.x < -0.5 ? 1 : 0; });
    const auto expect_dark_portal = [](const std::vector<nusselt::Vec3<float>>& vertices,
                                       const TexelMap& map) {
        const auto stored = table_of<float>(map);
        const auto light = portal_of(vertices, stored.table);
        expect_dark(
            WindowedPolygon<float, 8>(to_shading_space(light.plane, {0, 0, 0}, upright<float>()), light));
    };
    expect_dark_portal(rectangle_at<float>(1, -1, 1, -1, 1), black);
    expect_dark_portal(rectangle_at<float>(1, 0.5f, 1, -1, 1), left);
    // Behind the point, in a plane with it, without area, a point.
    expect_dark_portal(rectangle_at<float>(-1, -1, 1, -1, 1), white);
    expect_dark_portal(rectangle_at<float>(0, -1, 1, -1, 1), white);
    expect_dark_portal(rectangle_at<float>(0, 1, 2, -1, 1), white);
    expect_dark_portal(rectangle_at<float>(1, 1, 1, -1, 1), white);
    expect_dark_portal(rectangle_at<float>(1, 1, 1, 2, 2), white);
}

/// Windows as thin as a needle, or as small as a pixel of the sky: the measure is that of the closed form.
TEST(WindowedPolygon, SmallWindowsKeepTheirDigits) {
    const auto stored = table_of<float>(TexelMap(64, [](const Vector&) { return 1; }));
    for (const double size : {1e-1, 1e-3, 1e-5, 1e-7}) {
        for (const double thin : {1.0, 1e-3}) {
            const auto x = static_cast<float>(0.3), y = static_cast<float>(-0.7);
            const nusselt::Frame<float> frame = upright<float>();
            const auto w = static_cast<float>(size), h = static_cast<float>(size * thin);
            WindowedLight<float> light = portal_of(rectangle_at<float>(1, 0, w, 0, h), stored.table);
            light.plane.corner = {x, y, 1};
            const WindowedPolygon<float, 8> technique(to_shading_space(light.plane, {0, 0, 0}, frame), light);
            double expected = 0;
            for (int j = 0; j < 20; ++j)
                for (int i = 0; i < 20; ++i) {
                    const double p = x + size * (i + 0.5) / 20, q = y + size * thin * (j + 0.5) / 20;
                    expected += size * size * thin / 400 / ((1 + p * p + q * q) * (1 + p * p + q * q));
                }
            EXPECT_NEAR(technique.measure() / expected, 1, 2e-3) << size << " " << thin;
            Estimates estimates;
            for (int k = 0; k < 200; ++k) {
                const auto s = technique.sample({(static_cast<float>(k) + 0.5f) / 200,
                                                 std::fmod(0.618034f * static_cast<float>(k), 1.0f)});
                ASSERT_GT(s.pdf, 0);
                estimates.add(static_cast<double>(s.wi.z) / s.pdf / expected);
            }
            EXPECT_NEAR(estimates.mean(), 1, 5e-3) << size << " " << thin;
            EXPECT_LT(estimates.relative_variance(), 1e-4) << size << " " << thin;
        }
    }
}

/// A light that looks at the point is a portal that looks away from it, also next to their plane.
TEST(WindowedPolygon, LightsAndPortalsAreAlikeNextToTheirPlane) {
    const StoredTable<float> stored([](const auto&) { return grey<float>(1); },
                                    nusselt::RectifiedDomain<float>::hemisphere(), 64, 64, 1);
    const Frame<float> back{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
    const auto surface = Frame<float>::from_normal({0, 0.8f, 0.6f});
    for (const float height : {1.0f, 1e-2f, 1e-4f}) {
        const auto vertices = rectangle_at<float>(height, 1.3f, 2.7f, -0.4f, 0.9f);
        const auto portal = portal_of(vertices, stored.table);
        const auto light = nusselt::make_profiled_light(back, vertices.data(), 4, stored.table);
        const WindowedPolygon<float, 8> a(to_shading_space(portal.plane, {0, 0, 0}, surface), portal);
        const WindowedPolygon<float, 8> b(to_shading_space(light.plane, {0, 0, 0}, surface), light);
        const float expected = projected_solid_angle(
            to_shading_space(nusselt::make_polygon<4>(vertices.data(), 4), {0, 0, 0}, surface));
        EXPECT_GT(expected, 0);
        // Angles of cells are as large as their rounding errors at least, which matters here in the last case.
        const double tolerance = height < 1e-3f ? 2e-2 : 1e-3;
        EXPECT_NEAR(a.measure() / expected, 1, tolerance) << height;
        EXPECT_NEAR(b.measure() / expected, 1, tolerance) << height;
        const nusselt::Vec3<float> inside =
            surface.to_local(normalize(nusselt::Vec3<float>{1.9f, 0.3f, height}));
        EXPECT_NEAR(a.pdf(inside) / b.pdf(inside), 1, 1e-2) << height;
        EXPECT_EQ(WindowedPolygon<float>(to_shading_space(light.plane, {0, 0, 2 * height}, surface), light)
                      .measure(),
                  0);
    }
}

/// From points next to it, a light fills the hemisphere.
TEST(WindowedPolygon, LargeLightsKeepTheirDensity) {
    const StoredTable<float> stored([](const auto&) { return grey<float>(1); },
                                    nusselt::RectifiedDomain<float>::hemisphere(), 16, 16, 1);
    for (const float size : {1e3f, 1e5f, 1e6f, 1e7f, 1e9f}) {
        const auto portal = portal_of(rectangle_at<float>(1, -size, size, -size, size), stored.table);
        const WindowedPolygon<float, 8> technique(to_shading_space(portal.plane, {0, 0, 0}, upright<float>()),
                                                  portal);
        EXPECT_NEAR(technique.measure(), nusselt::kPi<float>, 1e-4f) << size;
        for (int k = 0; k < 1000; ++k) {
            const auto s = technique.sample(
                {(static_cast<float>(k) + 0.5f) / 1000, std::fmod(0.618034f * static_cast<float>(k), 1.0f)});
            ASSERT_NEAR(s.wi.z / s.pdf, nusselt::kPi<float>, 2e-3f) << size << " " << k;
            ASSERT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 2e-3f) << size << " " << k;
        }
    }
}

/// A texel of 1e30 takes all samples of windows with it, and none of the others.
TEST(WindowedPolygon, OneHugeTexelDoesNoHarm) {
    const TexelMap map(64, [](const Vector& w) {
        return dot(w, normalize(Vector{0.1, 0.1, 1})) > 0.999 ? 1e30 : 1;
    });
    const auto stored = table_of<float>(map);
    for (const bool has_sun : {true, false}) {
        const float left = has_sun ? -0.5f : 0.3f;
        const auto light = portal_of(rectangle_at<float>(1, left, left + 0.7f, -0.5f, 0.5f), stored.table);
        const WindowedPolygon<float, 8> technique(to_shading_space(light.plane, {0, 0, 0}, upright<float>()),
                                                  light);
        EXPECT_TRUE(technique.measure() > 0 && std::isfinite(technique.measure()));
        Estimates estimates;
        std::mt19937 random(3);
        std::uniform_real_distribution<float> uniform(0, 0.9999999f);
        for (int k = 0; k < 2000; ++k) {
            const float x = uniform(random);
            const auto s = technique.sample({x, uniform(random)});
            ASSERT_GT(s.pdf, 0);
            ASSERT_TRUE(std::isfinite(s.pdf));
            estimates.add(map.at_position(s.at) * static_cast<double>(s.wi.z) / s.pdf);
        }
        EXPECT_EQ(estimates.mean() > 1e20, has_sun);
        EXPECT_LT(estimates.relative_variance(), 0.1);
    }
}

/// Vertices of all sizes, many of them alike, frames and points in their planes, tables with huge and black parts.
template <class T, class Variant>
void expect_contract_on_hostile_lights(int count) {
    std::mt19937 random(6);
    const auto pick = [&](const std::vector<double>& values) {
        return static_cast<T>(
            values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)]);
    };
    const std::vector<double> coordinates = {0,     0.1,  1,   -1,   0.5,  2,    -0.7,  0.3333333, 1e-6,
                                             -1e-6, 1e-3, 1e6, -1e6, 1e-9, 1e15, -1e14, 1e-15};
    const std::vector<double> numbers = {0, 0.2503, 0.4997, 0.77, 0.9999, 1 - 1e-16};
    const TexelMap mixed(32, [](const Vector& w) { return w.x > 0.7 ? 0 : w.y > 0.8 ? 1e20 : 1 + w.x; });
    std::vector<StoredTable<T>> tables;
    tables.push_back(table_of<T>(rough_map()));
    tables.push_back(table_of<T>(smooth_map()));
    tables.push_back(table_of<T>(mixed));
    const nusselt::RadialSpread<T> spread{T(0.05)};
    tables.emplace_back([&](const auto& w) { return grey<T>(static_cast<double>(spread.share(w))); },
                        spread.domain(), 16, 8, 1);
    constexpr T kLargest = std::numeric_limits<T>::max();
    constexpr T kBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;
    int lit = 0, visible = 0, agree = 0;
    for (int k = 0; k < count; ++k) {
        const T scale = pick({1, 1, 1e-3, 1e4});
        const int vertices = std::uniform_int_distribution<int>(3, 5)(random);
        std::vector<nusselt::Vec3<T>> v;
        if (vertices == 4) {
            const T x0 = pick(coordinates), x1 = pick(coordinates), y0 = pick(coordinates);
            v = rectangle_at<T>(scale * pick(coordinates), scale * x0, scale * x1, scale * y0,
                                scale * pick(coordinates));
        } else {
            // Convex, with repeated and collinear vertices.
            const T x = scale * pick(coordinates), z = scale * pick(coordinates);
            v = {{0, 0, z}, {x, 0, z}, {x, scale * pick(coordinates), z}};
            for (int j = 3; j < vertices; ++j) v.push_back(v.back());
        }
        const auto& table = tables[static_cast<std::size_t>(k) % tables.size()].table;
        const Frame<T> turned = Frame<T>::from_normal(normalize(nusselt::Vec3<T>{T(0.3), T(0.2), T(0.7)}));
        Frame<T> frame = upright<T>();
        if (k % 3 == 0) {
            frame = turned;
            for (auto& each : v) each = turned.to_world(each);
        }
        const auto light =
            k % 2 == 0 ? nusselt::make_portal(frame, v.data(), static_cast<int>(v.size()), table)
                       : nusselt::make_profiled_light(frame, v.data(), static_cast<int>(v.size()), table);
        const T px = pick(coordinates), py = pick(coordinates);
        const auto normal =
            normalize(nusselt::Vec3<T>{pick({0, 0, 1, -1, 1e-3}), pick({0, 0, 1, 0.3}), pick({1, -1, 0.1})});
        const auto technique = Variant::technique(light, {scale * px, scale * py, scale * pick(coordinates)},
                                                  Frame<T>::from_normal(normal));
        ASSERT_TRUE(technique.measure() >= 0 && technique.measure() <= kLargest) << k;
        const auto colour = technique.unshadowed();
        ASSERT_TRUE(colour.x >= 0 && colour.y <= kLargest && colour.z >= 0) << k;
        const T x = std::min(pick(numbers), kBelowOne);
        const auto s = technique.sample({x, std::min(pick(numbers), kBelowOne)});
        ASSERT_TRUE(s.pdf >= 0 && s.pdf <= kLargest) << k;
        ASSERT_NEAR(static_cast<double>(length(s.wi)), 1, 1e-5) << k;
        if (s.pdf == 0) continue;
        ++lit;
        ASSERT_TRUE(Variant::kHasLobe || s.wi.z > 0) << k;
        ASSERT_TRUE(s.at.x >= 0 && s.at.x < 1 && s.at.y >= 0 && s.at.y < 1) << k;
        ASSERT_TRUE(length(s.p) <= kLargest) << k;
        const T again = technique.pdf(s.wi);
        ASSERT_TRUE(again >= 0 && again <= kLargest) << k;
        // Directions to lights below a thousandth of a radian have too few digits.
        if (s.pdf < T(1e6)) {
            ++visible;
            agree += std::fabs(again - s.pdf) < T(1e-2) * s.pdf;
        }
        const auto u = technique.invert(s.wi);
        ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1) << k;
    }
    EXPECT_GT(lit, count / 25);
    // Next to lines between texels or cells, rounding finds the other one.
    EXPECT_GT(agree, visible * 9 / 10) << visible;
}

TEST(WindowedPolygon, KeepsTheContractOnHostileLights) {
    expect_contract_on_hostile_lights<float, WindowedVariant<8, ProjectedCells>>(8000);
    expect_contract_on_hostile_lights<float, WindowedVariant<4, ProjectedCells>>(8000);
    expect_contract_on_hostile_lights<double, WindowedVariant<8, ProjectedCells>>(2000);
}

TEST(WindowedPolygon, KeepsTheContractOfLobesOnHostileLights) {
    expect_contract_on_hostile_lights<float, WindowedVariant<8, LobeCells>>(8000);
}

TEST(WindowedPolygon, LongDoubleKeepsTheContract) {
    expect_contract_on_hostile_lights<long double, WindowedVariant<8, ProjectedCells>>(500);
}

} // namespace
} // namespace nusselt_test
