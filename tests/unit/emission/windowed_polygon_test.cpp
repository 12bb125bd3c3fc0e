/// Tests of sampling of lights whose radiance depends on the direction: densities, inversion, means, hostile lights.

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/emission/profile_radiance.h>
#include <nusselt/emission/spread.h>

#include "emission/windowed_variants.h"

namespace nusselt_test {
namespace {

using nusselt::Frame;
using nusselt::LobeCells;
using nusselt::ProjectedCells;
using nusselt::RectifiedTable;
using nusselt::Vec2;
using nusselt::WindowedLight;
using nusselt::WindowedPolygon;
using Vector = nusselt::Vec3<double>;

template <class Variant>
class WindowedPolygonTest : public ::testing::Test {};
using Variants = ::testing::Types<WindowedVariant<8, ProjectedCells>, WindowedVariant<4, ProjectedCells>,
                                  WindowedVariant<8, LobeCells>>;
TYPED_TEST_SUITE(WindowedPolygonTest, Variants);

/// A window along lines of texels, seen from the origin at a distance.
struct AlignedView {
    int begin_x, end_x, begin_y, end_y;
    double distance;
    Vector normal; ///< of the surface
    bool is_cut;   ///< by the horizon

    template <class T>
    std::vector<nusselt::Vec3<T>> vertices() const {
        const auto at = [&](int i) {
            return static_cast<T>(distance *
                                  std::tan((static_cast<double>(i) / kTexels - 0.5) * nusselt::kPi<double>));
        };
        return rectangle_at<T>(static_cast<T>(distance), at(begin_x), at(end_x), at(begin_y), at(end_y));
    }
    template <class T>
    Frame<T> frame() const {
        return Frame<T>::from_normal(nusselt::broadcast<T>(normalize(normal)));
    }
};

const std::vector<AlignedView>& views() {
    static const std::vector<AlignedView> list = {
        {20, 44, 24, 40, 1, {0.2, 0.1, 1}, false}, {36, 44, 8, 24, 3, {0.4, -0.3, 1}, false},
        {2, 58, 4, 60, 0.1, {0, 0, 1}, false},     {30, 31, 31, 32, 50, {0.5, 0.5, 1}, false},
        {20, 44, 24, 40, 1, {1, 0.3, 0.2}, true},  {8, 56, 12, 52, 2, {-0.3, 1, 0.1}, true},
    };
    return list;
}

/// The integral over an aligned window of f(direction in the world, texel i, j).
template <class Function>
double window_integral(const AlignedView& view, int steps, const Function& f) {
    const double step = nusselt::kPi<double> / kTexels / steps;
    double sum = 0;
    for (int j = view.begin_y; j < view.end_y; ++j)
        for (int i = view.begin_x; i < view.end_x; ++i)
            for (int l = 0; l < steps; ++l)
                for (int k = 0; k < steps; ++k) {
                    const Vector w = smooth_map().direction_at(i + (k + 0.5) / steps, j + (l + 0.5) / steps);
                    sum += (1 - w.x * w.x) * (1 - w.y * w.y) / w.z * f(w, i, j);
                }
    return sum * step * step;
}

/// Where the horizon cuts texels, and where the lines of cells do, quadrature has an error. Samples below the horizon have no
/// density: what is missing is their share.
TYPED_TEST(WindowedPolygonTest, DensityIntegratesToOne) {
    for (const TexelMap* map : {&rough_map(), &smooth_map()}) {
        const auto stored = table_of<double>(*map);
        for (const AlignedView& view : views()) {
            const auto light = portal_of(view.vertices<double>(), stored.table);
            const auto frame = view.frame<double>();
            const auto technique = TypeParam::technique(light, {0, 0, 0}, frame);
            ASSERT_GT(technique.measure(), 0);
            const int steps = (view.end_x - view.begin_x) * (view.end_y - view.begin_y) > 1000 ? 3 : 8;
            const double sum = window_integral(
                view, steps, [&](const Vector& w, int, int) { return technique.pdf(frame.to_local(w)); });
            int dark = 0;
            constexpr int kSamples = 4096;
            std::mt19937 random(1);
            std::uniform_real_distribution<double> uniform(0, 1);
            for (int k = 0; k < kSamples; ++k) {
                const double x = uniform(random);
                dark += technique.sample({x, uniform(random)}).pdf == 0;
            }
            ASSERT_NEAR(sum + static_cast<double>(dark) / kSamples, 1, view.is_cut ? 2e-2 : 3e-3)
                << view.begin_x << " " << (map == &rough_map());
        }
    }
}

/// Convex polygons as portals at distance 1: seen from the origin.
std::vector<std::vector<Vector>> polygons() {
    std::vector<Vector> octagon;
    for (int k = 0; k < 8; ++k)
        octagon.push_back({0.9 * std::cos(0.3 + k * 0.785398), 0.1 + 0.7 * std::sin(0.3 + k * 0.785398), 1});
    return {{{-0.7, -0.5, 1}, {0.8, -0.3, 1}, {0.1, 0.9, 1}},
            {{0.2, 0.1, 1}, {0.2, 0.6, 1}, {1.4, 0.3, 1}},
            {{-1, -1, 1}, {2, -0.5, 1}, {1.5, 1, 1}, {-0.2, 1.5, 1}, {-0.9, 0.2, 1}},
            octagon};
}

/// The integral over a polygon at distance 1.
template <class Function>
double polygon_integral(const std::vector<Vector>& polygon, const Function& f) {
    constexpr int kSteps = 300;
    nusselt::TextureOutline<double> outline{{}, static_cast<int>(polygon.size())};
    double area = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k)
        area += det(xy(polygon[k - 1] - polygon[0]), xy(polygon[k] - polygon[0]));
    Vec2<double> low = xy(polygon[0]), high = low;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        outline.vertex[k] = xy(polygon[area < 0 ? polygon.size() - 1 - k : k]);
        low = {std::min(low.x, polygon[k].x), std::min(low.y, polygon[k].y)};
        high = {std::max(high.x, polygon[k].x), std::max(high.y, polygon[k].y)};
    }
    const Vec2<double> step = (high - low) / static_cast<double>(kSteps);
    double sum = 0;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const Vec2<double> at{low.x + (i + 0.5) * step.x, low.y + (j + 0.5) * step.y};
            if (!outline.contains(at, at)) continue;
            const Vector p{at.x, at.y, 1};
            const double squared = dot(p, p);
            sum += f(p / std::sqrt(squared)) / (squared * std::sqrt(squared));
        }
    return sum * step.x * step.y;
}

/// In cells that the outline cuts, samples of texels may be outside: they have no density.
TYPED_TEST(WindowedPolygonTest, ConvexPolygonsAreCovered) {
    for (const TexelMap* map : {&rough_map(), &smooth_map()}) {
        const auto stored = table_of<double>(*map);
        for (const auto& polygon : polygons()) {
            const auto light = portal_of(polygon, stored.table);
            const auto frame = Frame<double>::from_normal(normalize(Vector{0.1, 0.2, 1}));
            const auto technique = TypeParam::technique(light, {0, 0, 0}, frame);
            const double density =
                polygon_integral(polygon, [&](const Vector& w) { return technique.pdf(frame.to_local(w)); });
            const double expected = polygon_integral(
                polygon, [&](const Vector& w) { return (*map)(w)*TypeParam::integrand(frame.to_local(w)); });
            int dark = 0;
            Estimates estimates;
            std::mt19937 random(1);
            std::uniform_real_distribution<double> uniform(0, 1);
            constexpr int kSamples = 6000;
            for (int k = 0; k < kSamples; ++k) {
                const double x = uniform(random);
                const auto s = technique.sample({x, uniform(random)});
                dark += s.pdf == 0;
                estimates.add(s.pdf > 0 ? map->at_position(s.at) * TypeParam::integrand(s.wi) / s.pdf : 0);
            }
            ASSERT_NEAR(density + static_cast<double>(dark) / kSamples, 1, 2e-2);
            ASSERT_NEAR(estimates.mean() / expected, 1,
                        0.01 + 5 * std::sqrt(estimates.relative_variance() / kSamples));
            ASSERT_LT(dark, kSamples / 4);
        }
    }
}

TYPED_TEST(WindowedPolygonTest, SamplesDensitiesAndInversesAgree) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    int count = 0, wrong = 0;
    for (const TexelMap* map : {&rough_map(), &smooth_map()}) {
        const auto stored = table_of<double>(*map);
        const auto check = [&](const WindowedLight<double>& light, const Frame<double>& frame,
                               double distance) {
            const auto technique = TypeParam::technique(light, {0, 0, 0}, frame);
            for (int k = 0; k < 200; ++k) {
                const double x = uniform(random);
                const Vec2<double> u{x, uniform(random)};
                const auto s = technique.sample(u);
                if (s.pdf == 0) continue;
                ++count;
                ASSERT_NEAR(length(s.wi), 1, 1e-14);
                // The point is in the plane of the light, along the direction, and the texel is the right one.
                ASSERT_NEAR(frame.to_world(s.p).z, distance, 1e-12 * distance);
                ASSERT_LT(length(s.p - length(s.p) * s.wi), 1e-9 * length(s.p));
                ASSERT_GE(s.at.x, 0);
                ASSERT_LT(s.at.y, 1);
                const Vec2<double> inverse = technique.invert(s.wi);
                // Next to lines between texels or cells, rounding finds the other one.
                wrong += !(std::fabs(technique.pdf(s.wi) / s.pdf - 1) < 1e-7) ||
                         !(std::fabs(inverse.x - u.x) + std::fabs(inverse.y - u.y) < 1e-6) ||
                         map->at_position(s.at) != (*map)(frame.to_world(s.wi));
            }
        };
        for (const AlignedView& view : views())
            check(portal_of(view.vertices<double>(), stored.table), view.frame<double>(), view.distance);
        for (const auto& polygon : polygons())
            check(portal_of(polygon, stored.table),
                  Frame<double>::from_normal(normalize(Vector{0.1, 0.2, 1})), 1);
    }
    EXPECT_GT(count, 3000);
    EXPECT_LT(wrong, count / 1000 + 1);
}

/// The mean of many samples is the integral; those of mutants are not.
TYPED_TEST(WindowedPolygonTest, MeansAreRightAndThoseOfMutantsAreNot) {
    constexpr int kSamples = 20000;
    int rejected[4] = {0, 0, 0, 0};
    for (const TexelMap* map : {&rough_map(), &smooth_map()}) {
        const auto stored = table_of<double>(*map);
        for (const AlignedView& view : views()) {
            const auto light = portal_of(view.vertices<double>(), stored.table);
            const auto frame = view.frame<double>();
            const auto technique = TypeParam::technique(light, {0, 0, 0}, frame);
            const double expected =
                window_integral(view, view.is_cut ? 8 : 3, [&](const Vector& w, int i, int j) {
                    return map->at_texel(i, j) * TypeParam::integrand(frame.to_local(w));
                });
            Estimates right, shifted, flat, tilted, brighter;
            std::mt19937 random(9);
            std::uniform_real_distribution<double> uniform(0, 1);
            for (int k = 0; k < kSamples; ++k) {
                const double x = uniform(random);
                const auto s = technique.sample({x, uniform(random)});
                if (s.pdf == 0) {
                    for (Estimates* each : {&right, &shifted, &flat, &tilted, &brighter}) each->add(0);
                    continue;
                }
                const Vector w = frame.to_world(s.wi);
                const double value = map->at_position(s.at) * TypeParam::integrand(s.wi) / s.pdf;
                right.add(value);
                // The radiance of the next texel; no Jacobian; the cosine at the light in place of that at the surface.
                const double next =
                    map->at_position(Vec2<double>{std::min(s.at.x + 1.0 / kTexels, 0.999), s.at.y});
                shifted.add(next * TypeParam::integrand(s.wi) / s.pdf);
                flat.add(value * w.z / ((1 - w.x * w.x) * (1 - w.y * w.y)));
                tilted.add(value * w.z / std::max(s.wi.z, 1e-3));
                brighter.add(1.05 * value);
            }
            ASSERT_TRUE(right.agrees_with(expected, 1e-3)) << view.begin_x << " " << right.mean() / expected;
            const Estimates* mutants[4] = {&shifted, &flat, &tilted, &brighter};
            for (int k = 0; k < 4; ++k) rejected[k] += !mutants[k]->agrees_with(expected, 1e-3);
        }
    }
    // Not all views show all faults: where the radiance is smooth, texels are alike.
    EXPECT_GE(rejected[0], 5);
    EXPECT_GE(rejected[1], 10);
    EXPECT_GE(rejected[2], 8);
    EXPECT_GE(rejected[3], 10);
}

/// Without noise: radiance that is constant.
TYPED_TEST(WindowedPolygonTest, WeightsAreConstantWhereRadianceIs) {
    const StoredTable<double> stored(
        [](const auto&) {
            return Vector{1, 2, 6};
        },
        nusselt::RectifiedDomain<double>::hemisphere(), 32, 32, 1);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<std::vector<Vector>> lights = polygons();
    for (const AlignedView& view : views()) lights.push_back(view.vertices<double>());
    for (const auto& vertices : lights) {
        for (const Vector& normal : {Vector{0.1, 0.2, 1}, Vector{1, -0.2, 0.1}}) {
            const auto light = portal_of(vertices, stored.table);
            const auto technique =
                TypeParam::technique(light, {0, 0, 0}, Frame<double>::from_normal(normalize(normal)));
            for (int k = 0; k < 50; ++k) {
                const double x = uniform(random);
                const auto s = technique.sample({x, uniform(random)});
                if (s.pdf == 0) continue;
                ASSERT_NEAR(3 * TypeParam::integrand(s.wi) / s.pdf / technique.measure(), 1, 1e-6);
            }
            const double scale = technique.measure() / (TypeParam::kHasLobe ? 1 : nusselt::kPi<double>) / 3;
            ASSERT_NEAR(technique.unshadowed().x, scale, 1e-6 * scale);
            ASSERT_NEAR(technique.unshadowed().z, 6 * scale, 6e-6 * scale);
        }
    }
}

/// A light shines where the table says, in its own frame, to the side of its normal.
TEST(WindowedPolygon, ProfiledLightsEmitInTheirFrame) {
    const auto radiance = [](const auto& w) {
        return nusselt::profile_radiance<double>(w.x > 0 ? 179 * (1 + w.y) : 17.9, 179, 2, w.z);
    };
    const StoredTable<double> stored([&](const Vector& w) { return grey<double>(radiance(w)); },
                                     nusselt::RectifiedDomain<double>::hemisphere(), 128, 128, 2);
    const Frame<double> frame{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}; // shines down
    const std::vector<Vector> vertices = rectangle_at<double>(1, -1, 1, -0.5, 0.5);
    const auto light = nusselt::make_profiled_light(frame, vertices.data(), 4, stored.table);
    EXPECT_NEAR(light.area(), 2, 1e-12);
    for (const Vector& point : {Vector{0.1, 0.2, 0}, Vector{1.5, -0.7, 0.3}, Vector{-1, 2, -2}}) {
        const WindowedPolygon<double, 8> technique(to_shading_space(light.plane, point, upright<double>()),
                                                   light);
        double expected = 0;
        double mirrored = 0;
        constexpr int kSteps = 400;
        for (int j = 0; j < kSteps; ++j)
            for (int i = 0; i < kSteps; ++i) {
                const Vector p = Vector{-1 + 2 * (i + 0.5) / kSteps, -0.5 + (j + 0.5) / kSteps, 1} - point;
                const double squared = dot(p, p);
                const Vector w = frame.to_local(-normalize(p));
                const double factor = 2.0 / (kSteps * kSteps) * p.z * p.z / (squared * squared);
                expected += radiance(w) * factor;
                mirrored += radiance(Vector{-w.x, -w.y, w.z}) * factor;
            }
        Estimates estimates;
        std::mt19937 random(3);
        std::uniform_real_distribution<double> uniform(0, 1);
        for (int k = 0; k < 10000; ++k) {
            const double x = uniform(random);
            const auto s = technique.sample({x, uniform(random)});
            estimates.add(s.pdf > 0 ? radiance(frame.to_local(-s.wi)) * s.wi.z / s.pdf : 0);
        }
        EXPECT_TRUE(estimates.agrees_with(expected, 1e-3));
        EXPECT_FALSE(estimates.agrees_with(mirrored, 1e-3));
    }
    // From behind, it is black.
    const WindowedPolygon<double, 8> behind(
        to_shading_space(light.plane, {0, 0, 2}, Frame<double>::from_normal({0, 0, -1})), light);
    EXPECT_EQ(behind.measure(), 0);
}

/// Down to a degree, the light is cut to what shines on the point, and nothing of it is lost.
TEST(WindowedPolygon, GridsAreUnbiased) {
    const std::vector<Vector> vertices = rectangle_at<double>(1, -0.5, 0.5, -0.5, 0.5);
    const Frame<double> down{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
    const auto surface = Frame<double>::from_normal(normalize(Vector{0.3, -0.2, 1}));
    const auto check = [&](const auto& spread, const Vector& point) {
        const StoredTable<double> stored([&](const Vector& w) { return grey<double>(spread.share(w)); },
                                         spread.domain(), 64, 64, 2);
        const auto light = nusselt::make_profiled_light(down, vertices.data(), 4, stored.table);
        const WindowedPolygon<double, 8> technique(to_shading_space(light.plane, point, surface), light);
        Estimates right, level;
        std::mt19937 random(3);
        std::uniform_real_distribution<double> uniform(0, 1);
        for (int k = 0; k < 4000; ++k) {
            const double x = uniform(random);
            const auto s = technique.sample({x, uniform(random)});
            const Vector w = surface.to_world(s.wi);
            const double value = s.pdf > 0 ? spread.share(down.to_local(-w)) / s.pdf : 0;
            right.add(value * std::max(s.wi.z, 0.0));
            level.add(value * w.z);
        }
        // Over the part of the light around the foot of the point.
        const double reach = spread.domain().high.x * (1 - point.z);
        const Vec2<double> low{std::max(point.x - reach, -0.5), std::max(point.y - reach, -0.5)};
        const Vec2<double> high{std::min(point.x + reach, 0.5), std::min(point.y + reach, 0.5)};
        constexpr int kSteps = 200;
        double expected = 0;
        for (int j = 0; j < kSteps; ++j)
            for (int i = 0; i < kSteps; ++i) {
                const Vector p = Vector{low.x + (i + 0.5) / kSteps * (high.x - low.x),
                                        low.y + (j + 0.5) / kSteps * (high.y - low.y), 1} -
                                 point;
                const double squared = dot(p, p);
                expected += spread.share(down.to_local(-normalize(p))) * dot(p, surface.n) * p.z /
                            (squared * squared);
            }
        expected *= (high.x - low.x) * (high.y - low.y) / (kSteps * kSteps);
        EXPECT_TRUE(right.agrees_with(expected, 1e-3)) << right.mean() / expected;
        EXPECT_FALSE(level.agrees_with(expected, 1e-3));
    };
    for (const double degrees : {1.0, 10.0, 50.0}) {
        const double slope = std::tan(degrees * nusselt::kPi<double> / 180);
        for (const Vector& point : {Vector{0.1, 0.2, 0.4}, Vector{0.5, -0.499, -1}}) {
            check(nusselt::Honeycomb<double>{{slope, slope}}, point);
            check(nusselt::RadialSpread<double>{slope}, point);
        }
    }
}

/// In a window that holds a black half, and in busy cells.
TEST(WindowedPolygon, OnlyWhatIsLitIsChosen) {
    const nusselt::Honeycomb<float> honeycomb{{0.1f, 0.2f}};
    const StoredTable<float> stored(
        [&](const auto& w) { return grey<float>(static_cast<double>(honeycomb.share(w))); },
        honeycomb.domain(), 64, 64, 2);
    const auto vertices = rectangle_at<float>(1, -2, 0.05f, -2, 2);
    const auto light =
        nusselt::make_profiled_light({{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, vertices.data(), 4, stored.table);
    const WindowedPolygon<float, 8> technique(to_shading_space(light.plane, {0, 0, 0}, upright<float>()),
                                              light);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 0.9999999f);
    for (int k = 0; k < 5000; ++k) {
        const float x = uniform(random);
        const auto s = technique.sample({x, uniform(random)});
        ASSERT_GT(s.pdf, 0);
        ASSERT_LE(s.p.x, 0.05f + 1e-6f);
        ASSERT_GE(s.p.x, -0.1f - 1e-6f);
        ASSERT_LE(std::fabs(s.p.y), 0.2f + 1e-6f);
    }
    EXPECT_GT(technique.pdf(normalize(nusselt::Vec3<float>{0.04f, 0.1f, 1})), 0);
    EXPECT_EQ(technique.pdf(normalize(nusselt::Vec3<float>{0.06f, 0.1f, 1})), 0);
    EXPECT_EQ(technique.pdf(normalize(nusselt::Vec3<float>{-0.11f, 0.1f, 1})), 0);
    EXPECT_EQ(technique.pdf({0, 0, -1}), 0);
    // From beside, nothing passes.
    const WindowedPolygon<float, 8> beside(to_shading_space(light.plane, {1, 0, 0}, upright<float>()), light);
    EXPECT_EQ(beside.measure(), 0);
}

/// The same light and the same direction.
TYPED_TEST(WindowedPolygonTest, FloatAgreesWithDouble) {
    for (const TexelMap* map : {&rough_map(), &smooth_map()}) {
        const auto stored = table_of<double>(*map);
        const auto single = table_of<float>(*map);
        int count = 0, wrong = 0;
        for (const AlignedView& view : views()) {
            if (view.is_cut) continue;
            const auto light = portal_of(view.vertices<double>(), stored.table);
            const auto light_single = portal_of(view.vertices<float>(), single.table);
            const auto technique = TypeParam::technique(light, {0, 0, 0}, view.frame<double>());
            const auto technique_single = TypeParam::technique(light_single, {0, 0, 0}, view.frame<float>());
            EXPECT_NEAR(technique_single.measure() / technique.measure(), 1, 1e-3);
            for (int k = 0; k < 200; ++k) {
                const auto s = technique.sample({(k + 0.5) / 200, std::fmod(0.618034 * k + 0.3, 1.0)});
                const double pdf = technique_single.pdf(nusselt::broadcast<float>(s.wi));
                wrong += !(std::fabs(pdf / s.pdf - 1) < 5e-3);
                ++count;
            }
        }
        // Directions next to lines between texels.
        EXPECT_LT(wrong, count / 100) << (map == &rough_map());
    }
}

} // namespace
} // namespace nusselt_test
