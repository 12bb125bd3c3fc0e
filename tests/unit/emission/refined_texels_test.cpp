/// Tests of tables with texels that are refined.

#include <cmath>
#include <cstdio>
#include <random>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "emission/windowed_lights.h"

namespace nusselt_test {
namespace {

using nusselt::Frame;
using nusselt::Vec2;
using nusselt::WindowedPolygon;
using Vector = nusselt::Vec3<double>;

constexpr int kTexels = 64;

/// A sun of four degrees in a dim sky.
template <class T>
T radiance_towards(const nusselt::Vec3<T>& w) {
    const T cosine = dot(w, normalize(nusselt::Vec3<T>{T(0.3), T(0.2), T(1)}));
    return T(0.2) + T(0.1) * w.x + T(200) * std::exp(T(900) * (cosine - T(1)));
}

template <class T>
const RefinedTable<T>& table() {
    static const RefinedTable<T> refined(
        [](const nusselt::Vec3<T>& w) { return grey<T>(static_cast<double>(radiance_towards(w))); }, kTexels);
    return refined;
}

template <class T>
struct View {
    std::vector<nusselt::Vec3<T>> vertices;
    Frame<T> frame;
};

/// Windows that cut texels of the sun at odd places, one that is smaller than a part of a texel, and a pentagon.
template <class T>
std::vector<View<T>> views() {
    const auto upright = Frame<T>::from_normal(normalize(nusselt::Vec3<T>{T(0.2), T(0.1), T(1)}));
    const auto tilted = Frame<T>::from_normal(normalize(nusselt::Vec3<T>{T(-1), T(0.3), T(0.5)}));
    return {
        {rectangle_at<T>(1, T(-0.5), T(0.9), T(-0.6), T(0.7)), upright},
        {rectangle_at<T>(2, T(0.583), T(0.77), T(0.393), T(0.52)), upright},
        {rectangle_at<T>(1, T(0.3), T(0.3001), T(0.21), T(0.2101)), upright},
        {rectangle_at<T>(T(0.2), T(-1), T(2), T(-1), T(1)), tilted},
        {{{T(-0.2), T(0.1), 1}, {T(0.31), T(-0.4), 1}, {T(0.8), 0, 1}, {T(0.5), T(0.8), 1}, {0, T(0.7), 1}},
         upright}};
}

template <class T>
class RefinedTexelsTest : public ::testing::Test {};
using Numbers = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(RefinedTexelsTest, Numbers);

TYPED_TEST(RefinedTexelsTest, AreThoseAtTheEdgeOfTheSun) {
    const auto& refined = table<TypeParam>().table.refined;
    EXPECT_GT(refined.count, 4);
    EXPECT_LT(refined.count, 64);
    for (int k = 0; k < refined.count; ++k) {
        EXPECT_EQ(refined.find(refined.texel[k]), refined.weight + k * refined.kSize);
        TypeParam sum = 0;
        for (int i = 0; i < refined.kSize; ++i) {
            EXPECT_GT(refined.weight[k * refined.kSize + i], TypeParam(0));
            sum += refined.weight[k * refined.kSize + i];
        }
        EXPECT_NEAR(static_cast<double>(sum), refined.kSize, 1e-3);
    }
    EXPECT_EQ(refined.find(0), nullptr);
    EXPECT_EQ(refined.find(kTexels * kTexels - 1), nullptr);
}

TYPED_TEST(RefinedTexelsTest, SamplesDensitiesAndInversesAgree) {
    using T = TypeParam;
    constexpr bool is_float = std::is_same_v<T, float>;
    const double rounding = is_float ? 2e-3 : 1e-6;
    for (const View<T>& view : views<T>()) {
        const auto light = portal_of(view.vertices, table<T>().table);
        const WindowedPolygon<T, 8> technique(to_shading_space(light.plane, {0, 0, 0}, view.frame), light);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> uniform(0, 0.999999);
        int differ = 0;
        constexpr int kSamples = 1000;
        for (int k = 0; k < kSamples; ++k) {
            const double x = uniform(random), y = uniform(random);
            const auto s = technique.sample({static_cast<T>(x), static_cast<T>(y)});
            if (!(s.pdf > T(0))) continue;
            const double pdf = static_cast<double>(s.pdf);
            const auto u = technique.invert(s.wi);
            const bool agrees = std::fabs(static_cast<double>(technique.pdf(s.wi)) - pdf) < rounding * pdf &&
                                std::fabs(static_cast<double>(u.x) - x) < 5 * rounding &&
                                std::fabs(static_cast<double>(u.y) - y) < 5 * rounding;
            // Next to lines between parts, texels or cells, rounding may choose the other side.
            differ += !agrees;
        }
        EXPECT_LE(differ, is_float ? 10 : 0);
    }
}

/// Estimates of the light through windows are those of the polygon, and those of a mutant that forgets the parts are not.
TEST(RefinedTexels, MeansAreRightAndThoseOfMutantsAreNot) {
    auto plain = table<double>().table;
    plain.refined.count = 0;
    int better = 0, rejected = 0;
    for (const View<double>& view : views<double>()) {
        const auto light = portal_of(view.vertices, table<double>().table);
        const auto unrefined = portal_of(view.vertices, plain);
        const auto plane = to_shading_space(light.plane, {0, 0, 0}, view.frame);
        const WindowedPolygon<double, 8> technique(plane, light), forgetful(plane, unrefined);
        Estimates estimates, reference, mutant;
        std::mt19937 random(2);
        std::uniform_real_distribution<double> uniform(0, 1);
        const auto light_over = [&](const auto& s, double pdf) {
            return pdf > 0 ? radiance_towards(view.frame.to_world(s.wi)) * std::max(s.wi.z, 0.0) / pdf : 0;
        };
        for (int k = 0; k < 20000; ++k) {
            const double x = uniform(random), y = uniform(random);
            const auto s = technique.sample({x, y});
            estimates.add(light_over(s, s.pdf));
            mutant.add(light_over(s, s.pdf > 0 ? forgetful.pdf(s.wi) : 0));
            const auto other = forgetful.sample({y, x});
            reference.add(light_over(other, other.pdf));
        }
        const double error = 5 * std::sqrt(std::max(reference.relative_variance(), 0.0) / reference.count);
        EXPECT_TRUE(estimates.agrees_with(reference.mean(), error + 1e-6));
        std::printf("relative variance %.4f, %.4f without parts\n", estimates.relative_variance(),
                    reference.relative_variance());
        rejected += !mutant.agrees_with(reference.mean(), error + 1e-6);
        better += estimates.relative_variance() < 0.5 * reference.relative_variance();
    }
    EXPECT_GE(better, 3);
    EXPECT_GE(rejected, 3);
}

} // namespace
} // namespace nusselt_test
