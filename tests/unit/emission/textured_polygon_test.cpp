/// Tests of sampling of polygons with textures: densities, inversion, weights, hostile lights.

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "emission/estimates.h"
#include "emission/textured_lights.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::BilinearFilter;
using nusselt::DescentByProduct;
using nusselt::DescentByRadiance;
using nusselt::LobeCells;
using nusselt::make_texture_plane;
using nusselt::NearestFilter;
using nusselt::ProjectedCells;
using nusselt::TexturedPolygon;
using nusselt::Vec2;
template <class T>
using Plane = nusselt::TexturePlane<T>;

/// Noise over many orders of magnitude, and black parts: most cells are busy.
const SquareTexture<double>& rough_texture() {
    static const SquareTexture<double> texture = [] {
        std::mt19937 random(2);
        std::uniform_real_distribution<double> uniform(0, 1);
        return SquareTexture<double>(
            64, [&](int i, int j) { return (i / 10 + j / 10) % 3 == 0 ? 0 : std::pow(uniform(random), 8); });
    }();
    return texture;
}

/// Hardly any noise: most cells are smooth.
const SquareTexture<double>& smooth_texture() {
    static const SquareTexture<double> texture(64, [](int i, int j) { return 1 + 0.02 * i + 0.01 * j; });
    return texture;
}

/// All above the horizon.
std::vector<Plane<double>> whole_planes() {
    return {
        make_texture_plane<double>({-0.5, -0.4, 1}, {1, 0.1, 0}, {0, 0.9, 0.3}),
        make_texture_plane<double>({0.5, 1, 0.1}, {0, 0.2, 1.2}, {-1.1, 0.1, 0}),
        make_texture_plane<double>({-0.3, -0.2, 0.2}, {1, 0, 0.05}, {0, 1, 0}),
        make_texture_plane<double>({3, -7, 20}, {1, 0.3, 0}, {0, 1, 1}),
    };
}

std::vector<Plane<double>> cut_planes() {
    return {
        make_texture_plane<double>({1, -0.6, -0.4}, {0, 1, 0.1}, {0.1, 0, 1}),
        make_texture_plane<double>({-5, 40, -0.8}, {1, 0, 1.4}, {0, 0.4, 1}),
    };
}

template <class T>
nusselt::Ltc<T> glossy_lobe() {
    const auto c = tilted_lobe(0.5L, 0.4L, 1.1L, 0.1L);
    return nusselt::Ltc<T>({static_cast<T>(c.m00), static_cast<T>(c.m02), static_cast<T>(c.m11),
                            static_cast<T>(c.m20), static_cast<T>(c.m22), T(1)});
}

/// One kind of technique: lattice, descent and measure.
template <int n_, class Descent_, template <class> class Measure_>
struct Variant {
    static constexpr int n = n_;
    static constexpr bool kHasLobe = std::is_same_v<Measure_<double>, LobeCells<double>>;
    template <class T>
    using Technique = TexturedPolygon<T, n, Descent_, Measure_<T>>;

    template <class T>
    static Technique<T> technique(const Plane<T>& plane, const nusselt::TexturedLight<T, n>& light) {
        if constexpr (kHasLobe)
            return Technique<T>(plane, light, {glossy_lobe<T>()});
        else
            return Technique<T>(plane, light);
    }
    /// The integrand that the technique is for, without the texture.
    template <class T>
    static T integrand(const nusselt::Vec3<T>& wi) {
        if constexpr (kHasLobe)
            return glossy_lobe<T>().density(wi);
        else
            return std::max(wi.z, T(0));
    }
};

template <class Variant>
class TexturedPolygonTest : public ::testing::Test {};
using Variants =
    ::testing::Types<Variant<16, DescentByRadiance, ProjectedCells>,
                     Variant<8, DescentByProduct, ProjectedCells>, Variant<16, DescentByRadiance, LobeCells>>;
TYPED_TEST_SUITE(TexturedPolygonTest, Variants);

/// Calls f(texture, outline, plane, light, is_cut) for all combinations.
template <int n, class Function>
void for_each_light(const Function& f) {
    for (const SquareTexture<double>* texture : {&rough_texture(), &smooth_texture()}) {
        for (const auto& outline : outlines<double>()) {
            const StoredLight<double, n> stored(NearestFilter(), texture->view(), outline);
            for (const auto& plane : whole_planes()) f(*texture, plane, stored.light, false);
            for (const auto& plane : cut_planes()) f(*texture, plane, stored.light, true);
        }
    }
}

/// Where the horizon or the outline cuts texels, quadrature has an error of the order of a texel. Samples that end below the
/// horizon have no density: what is missing is their share.
TYPED_TEST(TexturedPolygonTest, DensityIntegratesToOne) {
    int count = 0;
    for_each_light<TypeParam::n>(
        [&](const SquareTexture<double>&, const Plane<double>& plane, const auto& light, bool is_cut) {
            // Two of five, which are other planes for each outline.
            if (count++ % 5 >= 2) return;
            const auto technique = TypeParam::technique(plane, light);
            if (!(technique.measure() > 0)) return;
            constexpr int kSteps = 128;
            double sum = 0;
            for (int j = 0; j < kSteps; ++j) {
                for (int i = 0; i < kSteps; ++i) {
                    const Vec2<double> at{(i + 0.5) / kSteps, (j + 0.5) / kSteps};
                    if (light.outline.contains(at, at))
                        sum += technique.pdf_at(at) * solid_angle_density(plane, at) / (kSteps * kSteps);
                }
            }
            int dark = 0;
            constexpr int kSamples = 4096;
            std::mt19937 random(1);
            std::uniform_real_distribution<double> uniform(0, 1);
            for (int k = 0; k < kSamples; ++k) {
                const double x = uniform(random);
                dark += technique.sample({x, uniform(random)}).pdf == 0;
            }
            const bool is_square = light.pieces == 0 && light.covered() == 1;
            ASSERT_NEAR(sum + static_cast<double>(dark) / kSamples, 1, is_square && !is_cut ? 3e-3 : 3e-2);
        });
}

/// Up to rounding.
bool is_inside(const nusselt::TextureOutline<double>& outline, const Vec2<double>& at) {
    double least = 1;
    for (int k = 0; k < outline.count; ++k)
        least = std::min(least, det(outline.end_of(k) - outline.vertex[k], at - outline.vertex[k]));
    return least > -1e-9;
}

TYPED_TEST(TexturedPolygonTest, SamplesDensitiesAndInversesAgree) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    int count = 0;
    for_each_light<TypeParam::n>(
        [&](const SquareTexture<double>&, const Plane<double>& plane, const auto& light, bool) {
            const auto technique = TypeParam::technique(plane, light);
            for (int k = 0; k < 60; ++k) {
                const double x = uniform(random);
                const Vec2<double> u{x, uniform(random)};
                const auto s = technique.sample(u);
                if (s.pdf == 0) continue;
                ++count;
                // The sample is on the light, where it emits.
                ASSERT_NEAR(length(s.wi), 1, 1e-14);
                ASSERT_LT(length(s.p - plane.point_at(s.at)), 1e-9 * length(s.p));
                ASSERT_LT(length(s.p - length(s.p) * s.wi), 1e-9 * length(s.p));
                ASSERT_TRUE(is_inside(light.outline, s.at));
                ASSERT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e-7);
                ASSERT_NEAR(technique.pdf_at(s.at) / s.pdf, 1, 1e-7);
                const Vec2<double> inverse = technique.invert(s.wi);
                ASSERT_NEAR(inverse.x, u.x, 1e-6);
                ASSERT_NEAR(inverse.y, u.y, 1e-6);
            }
        });
    EXPECT_GT(count, 1000);
}

/// Without noise: textures that are constant, or constant in each cell where these are not cut.
TYPED_TEST(TexturedPolygonTest, WeightsAreConstantWhereTheTextureIsConstantPerCell) {
    const SquareTexture<double> white(32, [](int, int) { return 0.3; });
    const SquareTexture<double> cells(TypeParam::n, [](int i, int j) { return (7 * i + 3 * j) % 5; });
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const SquareTexture<double>* texture : {&white, &cells}) {
        for (const auto& outline : outlines<double>()) {
            const StoredLight<double, TypeParam::n> stored(NearestFilter(), texture->view(), outline);
            auto planes = whole_planes();
            for (const auto& plane : cut_planes()) planes.push_back(plane);
            for (std::size_t k = 0; k < planes.size(); ++k) {
                const auto technique = TypeParam::technique(planes[k], stored.light);
                // Far cells have the cosine of their centre.
                const double tolerance = k == 3 || k == 5 ? 1e-6 : 1e-8;
                for (int i = 0; i < 40; ++i) {
                    const double x = uniform(random);
                    const auto s = technique.sample({x, uniform(random)});
                    if (s.pdf == 0) continue;
                    const double radiance = NearestFilter::lookup(texture->view(), s.at).x;
                    const double weight = radiance * TypeParam::integrand(s.wi) / s.pdf;
                    ASSERT_NEAR(weight / technique.measure(), 1, tolerance) << k;
                }
                const double coefficient = technique.unshadowed().y;
                const double expected =
                    technique.measure() / (TypeParam::kHasLobe ? 1 : nusselt::kPi<double>);
                ASSERT_NEAR(coefficient, expected, 1e-12);
            }
        }
    }
}

/// Channels count alike for probabilities, and each has its own coefficient.
TEST(TexturedPolygon, CoefficientsArePerChannel) {
    std::vector<nusselt::Vec3<double>> texels(256, {1, 2, 6});
    const StoredLight<double, 16> stored(NearestFilter(), {texels.data(), 16, 16}, unit_square<double>());
    const auto plane = whole_planes()[0];
    const TexturedPolygon<double, 16> technique(plane, stored.light);
    const double angle = projected_solid_angle(nusselt::rectangle_in<double>(plane, {0, 0}, {1, 1}));
    EXPECT_NEAR(technique.measure(), 3 * angle, 1e-12);
    EXPECT_NEAR(technique.unshadowed().x, angle / nusselt::kPi<double>, 1e-12);
    EXPECT_NEAR(technique.unshadowed().z, 6 * angle / nusselt::kPi<double>, 1e-12);
}

/// In busy cells, between bright texels.
TEST(TexturedPolygon, BlackTexelsAreNeverChosen) {
    const SquareTexture<float> texture(64, [](int i, int j) { return i % 7 == 0 && j % 9 == 0 ? 5 : 0; });
    const StoredLight<float, 16> stored(NearestFilter(), texture.view(), unit_square<float>());
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(0, 0.9999999f);
    for (const auto& plane : {whole_planes()[0], whole_planes()[3]}) {
        const TexturedPolygon<float, 16> technique(converted<float>(plane), stored.light);
        for (int k = 0; k < 20000; ++k) {
            const float x = uniform(random);
            const auto s = technique.sample({x, uniform(random)});
            ASSERT_GT(s.pdf, 0);
            ASSERT_EQ(NearestFilter::lookup(texture.view(), s.at).x, 5);
        }
    }
}

/// Weights have to know the filter: texels next to bright ones emit.
TEST(TexturedPolygon, BilinearTexturesAreUnbiased) {
    const SquareTexture<double> texture(64, [](int i, int j) { return i % 7 == 0 && j % 9 == 0 ? 5 : 0; });
    const StoredLight<double, 16> right(BilinearFilter(), texture.view(), unit_square<double>());
    const StoredLight<double, 16> wrong(NearestFilter(), texture.view(), unit_square<double>());
    const auto plane = whole_planes()[0];
    constexpr int kSteps = 256;
    const auto mean_of = [](const auto& f) {
        double sum = 0;
        for (int k = 0; k < kSteps * kSteps; ++k)
            sum += f(Vec2<double>{(k % kSteps + 0.5) / kSteps, (k / kSteps + 0.5) / kSteps});
        return sum / (kSteps * kSteps);
    };
    const double expected = mean_of([&](const Vec2<double>& at) {
        const double radiance = BilinearFilter::lookup(texture.view(), at).x;
        return radiance * normalize(plane.point_at(at)).z * solid_angle_density(plane, at);
    });
    const auto estimate = [&](const nusselt::TexturedLight<double, 16>& light) {
        const TexturedPolygon<double, 16> technique(plane, light);
        return mean_of([&](const Vec2<double>& u) {
            const auto s = technique.sample(u);
            return s.pdf > 0 ? BilinearFilter::lookup(texture.view(), s.at).x * s.wi.z / s.pdf : 0;
        });
    };
    EXPECT_NEAR(estimate(right.light) / expected, 1, 0.02);
    EXPECT_LT(estimate(wrong.light) / expected, 0.9);
}

TEST(TexturedPolygon, NothingComesFromWhatCannotBeSeen) {
    const SquareTexture<float> black(16, [](int, int) { return 0; });
    const SquareTexture<float> white(16, [](int, int) { return 1; });
    const StoredLight<float, 16> dark(NearestFilter(), black.view(), unit_square<float>());
    const StoredLight<float, 16> lit(NearestFilter(), white.view(), unit_square<float>());
    using Technique = TexturedPolygon<float, 16>;
    expect_dark(Technique{make_texture_plane<float>({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}), dark.light});
    // Below the surface, around the shading point, in a plane with it, without area, a point.
    expect_dark(Technique{make_texture_plane<float>({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), lit.light});
    expect_dark(Technique{make_texture_plane<float>({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), lit.light});
    expect_dark(Technique{make_texture_plane<float>({1, 0, 0.5f}, {2, 0, 0}, {0, 0, 2}), lit.light});
    expect_dark(Technique{make_texture_plane<float>({1, 1, 1}, {1, 2, 3}, {2, 4, 6}), lit.light});
    expect_dark(Technique{make_texture_plane<float>({1, 1, 1}, {1, 2, 3}, {0, 0, 0}), lit.light});
    expect_dark(Technique{make_texture_plane<float>({1, 1, 1}, {0, 0, 0}, {0, 0, 0}), lit.light});
}

/// Corners and sides of all sizes, many of them parallel, in the plane of the light, or at the shading point.
template <class T, class Variant>
void expect_contract_on_hostile_lights(int count) {
    std::mt19937 random(6);
    const auto pick = [&](const std::vector<double>& values) {
        return static_cast<T>(
            values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)]);
    };
    const std::vector<double> coordinates = {0, 0, 1, -1, 0.5, 1e-6, -1e-6, 1e-3, 1e6, -1e6, 1e-9, 0.3333333};
    const std::vector<double> numbers = {0, 0.25, 0.5, 0.77, 0.9999, 1 - 1e-16};
    const auto texels = SquareTexture<T>(
        32, [&](int i, int j) { return rough_texture().texels[static_cast<std::size_t>(64 * j + i)].x; });
    std::vector<StoredLight<T, Variant::n>> lights;
    for (const auto& outline : outlines<T>()) lights.emplace_back(NearestFilter(), texels.view(), outline);
    constexpr T kLargest = std::numeric_limits<T>::max();
    int lit = 0;
    for (int k = 0; k < count; ++k) {
        T c[9];
        for (T& x : c) x = pick(coordinates);
        const T scale = pick({1, 1, 1e-3, 1e4});
        const auto plane = make_texture_plane<T>({scale * c[0], scale * c[1], scale * c[2]},
                                                 {scale * c[3], scale * c[4], scale * c[5]},
                                                 {scale * c[6], scale * c[7], scale * c[8]});
        const auto& light = lights[static_cast<std::size_t>(k) % lights.size()].light;
        const auto technique = Variant::technique(plane, light);
        ASSERT_TRUE(technique.measure() >= 0 && technique.measure() <= kLargest);
        const T x = std::min(pick(numbers), 1 - std::numeric_limits<T>::epsilon() / 2);
        const auto s =
            technique.sample({x, std::min(pick(numbers), 1 - std::numeric_limits<T>::epsilon() / 2)});
        ASSERT_TRUE(s.pdf >= 0 && s.pdf <= kLargest) << k;
        ASSERT_NEAR(static_cast<double>(length(s.wi)), 1, 1e-5) << k;
        if (s.pdf == 0) continue;
        ++lit;
        ASSERT_TRUE(Variant::kHasLobe || s.wi.z > 0) << k;
        ASSERT_TRUE(s.at.x >= 0 && s.at.x < 1 && s.at.y >= 0 && s.at.y < 1) << k;
        ASSERT_TRUE(length(s.p) <= kLargest) << k;
        const T reach =
            std::max({nusselt::detail::extent_of(plane.corner), nusselt::detail::extent_of(plane.side_x),
                      nusselt::detail::extent_of(plane.side_y)});
        const T off = std::fabs(dot(plane.normal, s.p - plane.corner));
        // As for all techniques (proof/hostile/contract.h).
        ASSERT_LE(off, 84 * std::numeric_limits<T>::epsilon() * reach) << k;
        const T again = technique.pdf(s.wi);
        ASSERT_TRUE(again >= 0 && again <= kLargest) << k;
        const auto u = technique.invert(s.wi);
        ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1) << k;
    }
    EXPECT_GT(lit, count / 20);
}

TYPED_TEST(TexturedPolygonTest, KeepsTheContractOnHostileLights) {
    expect_contract_on_hostile_lights<float, TypeParam>(8000);
    expect_contract_on_hostile_lights<double, TypeParam>(1000);
}

TEST(TexturedPolygon, LongDoubleKeepsTheContract) {
    expect_contract_on_hostile_lights<long double, Variant<8, DescentByProduct, ProjectedCells>>(500);
}

/// The same light and the same direction.
TYPED_TEST(TexturedPolygonTest, FloatAgreesWithDouble) {
    constexpr int n = TypeParam::n;
    const SquareTexture<float> single(64, [](int i, int j) { return 1 + 0.02 * i + 0.01 * j; });
    const StoredLight<double, n> light(NearestFilter(), smooth_texture().view(), unit_square<double>());
    const StoredLight<float, n> light_single(NearestFilter(), single.view(), unit_square<float>());
    for (const auto& plane : whole_planes()) {
        const auto technique = TypeParam::technique(plane, light.light);
        const auto technique_single = TypeParam::technique(converted<float>(plane), light_single.light);
        EXPECT_NEAR(technique_single.measure() / technique.measure(), 1, 1e-5);
        for (int k = 0; k < 200; ++k) {
            const Vec2<double> u{(k + 0.5) / 200, std::fmod(0.618034 * k + 0.3, 1.0)};
            const auto s = technique.sample(u);
            const float pdf = technique_single.pdf_at(nusselt::broadcast<float>(s.at));
            ASSERT_NEAR(pdf / s.pdf, 1, 2e-3);
        }
    }
}

} // namespace
} // namespace nusselt_test
