/// The noise of one sample without shadows, and that its mean is right: 24 views of a unit square per distance.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "emission/estimates.h"
#include "emission/textured_lights.h"

namespace nusselt_test {
namespace {

using nusselt::DescentByProduct;
using nusselt::NearestFilter;
using nusselt::PolygonProjectedSolidAngle;
using nusselt::TexturedPolygon;
using nusselt::Vec2;
using View = nusselt::TexturePlane<double>;

constexpr int kSize = 256;
constexpr int kViews = 24;

/// The integrals of all textures times an integrand over the light, by its values at the centres of texels.
template <class Integrand>
std::vector<double> integrals(const View& view, const std::vector<NamedTexture>& textures,
                              const Integrand& integrand) {
    std::vector<double> sums(textures.size(), 0);
    for (int j = 0; j < kSize; ++j) {
        for (int i = 0; i < kSize; ++i) {
            const Vec2<double> at{(i + 0.5) / kSize, (j + 0.5) / kSize};
            const double value = integrand(normalize(view.point_at(at))) * solid_angle_density(view, at);
            for (std::size_t k = 0; k < textures.size(); ++k)
                sums[k] += static_cast<double>(
                               textures[k].texture.texels[static_cast<std::size_t>(j * kSize + i)].x) *
                           value;
        }
    }
    for (double& sum : sums) sum /= kSize * kSize;
    return sums;
}

template <int n>
std::vector<StoredLight<float, n>> lights_for(const std::vector<NamedTexture>& textures) {
    std::vector<StoredLight<float, n>> lights;
    for (const NamedTexture& named : textures)
        lights.emplace_back(NearestFilter(), named.texture.view(), unit_square<float>());
    return lights;
}

/// Estimates of a technique whose samples have texture coordinates.
template <class Technique, class Integrand>
auto estimates(const Technique& technique, const NamedTexture& named, const Integrand& integrand) {
    return [&](const Vec2<float>& u) {
        const auto s = technique.sample(u);
        if (s.pdf == 0) return 0.0;
        const float radiance = NearestFilter::lookup(named.texture.view(), s.at).x;
        return static_cast<double>(radiance * integrand(s.wi)) / s.pdf;
    };
}

struct Budgets {
    double cells16, cells8, product;
};

void report(double distance, const std::string& texture, const std::string& technique,
            const Moments& moments) {
    std::printf("distance %g, %s, %s: noise %.4f, bias %.5f\n", distance, texture.c_str(), technique.c_str(),
                moments.noise(), moments.bias());
}

/// The mean of many samples is within 5 of its standard deviations of the integral, which quadrature knows to 1e-3.
void expect_unbiased(const Moments& moments, int samples) {
    EXPECT_LT(std::fabs(moments.bias()), 5 * moments.noise() / std::sqrt(samples * kViews) + 1.5e-3);
}

void measure(double distance, int samples, const std::map<std::string, Budgets>& budgets) {
    const std::vector<NamedTexture>& textures = named_textures();
    const auto lights16 = lights_for<16>(textures);
    const auto lights8 = lights_for<8>(textures);
    struct Row {
        Moments psa, cells16, cells8, product;
    };
    std::vector<Row> rows(textures.size());
    const auto cosine = [](const auto& wi) { return std::max(wi.z, wi.z * 0); };
    for (const View& view : views_of_unit_square(distance, kViews)) {
        const std::vector<double> expected = integrals(view, textures, cosine);
        const auto plane = converted<float>(view);
        for (std::size_t k = 0; k < textures.size(); ++k) {
            const TexturedPolygon<float, 16> cells16(plane, lights16[k].light);
            const TexturedPolygon<float, 8> cells8(plane, lights8[k].light);
            const TexturedPolygon<float, 8, DescentByProduct> product(plane, lights8[k].light);
            Row& row = rows[k];
            row.cells16.add(expected[k], samples, estimates(cells16, textures[k], cosine));
            row.cells8.add(expected[k], samples, estimates(cells8, textures[k], cosine));
            row.product.add(expected[k], samples, estimates(product, textures[k], cosine));
            // The technique that knows nothing of the texture.
            const PolygonProjectedSolidAngle<float, 4> psa(
                nusselt::rectangle_in<float>(plane, {0, 0}, {1, 1}));
            const nusselt::TextureCoordinates<float> coordinates(plane);
            row.psa.add(expected[k], samples, [&](const Vec2<float>& u) {
                const auto s = psa.sample(u);
                return static_cast<double>(
                           NearestFilter::lookup(textures[k].texture.view(), coordinates(s.p)).x * s.wi.z) /
                       s.pdf;
            });
        }
    }
    for (std::size_t k = 0; k < textures.size(); ++k) {
        const std::string& name = textures[k].name;
        report(distance, name, "projected solid angle", rows[k].psa);
        report(distance, name, "16 x 16", rows[k].cells16);
        report(distance, name, "8 x 8", rows[k].cells8);
        report(distance, name, "8 x 8, product", rows[k].product);
        const Budgets& budget = budgets.at(name);
        EXPECT_LE(rows[k].cells16.noise(), budget.cells16) << name;
        EXPECT_LE(rows[k].cells8.noise(), budget.cells8) << name;
        EXPECT_LE(rows[k].product.noise(), budget.product) << name;
        expect_unbiased(rows[k].cells16, samples);
        expect_unbiased(rows[k].cells8, samples);
        expect_unbiased(rows[k].product, samples);
    }
}

TEST(TexturedNoise, AtDistanceOne) {
    measure(1, 250,
            {{"constant", {1e-3, 1e-3, 1e-3}},
             {"gradient", {0.03, 0.06, 0.06}},
             {"television", {0.08, 0.16, 0.08}},
             {"stained glass", {0.06, 0.16, 0.06}},
             {"spikes", {0.1, 0.16, 0.15}}});
}

/// Close, cells are smooth and the noise of the texture inside of them remains.
TEST(TexturedNoise, AtAQuarterOfTheSize) {
    measure(0.25, 100,
            {{"constant", {1e-3, 1e-3, 1e-3}},
             {"gradient", {0.035, 0.07, 0.07}},
             {"television", {0.35, 0.6, 0.4}},
             {"stained glass", {0.35, 0.6, 0.5}},
             {"spikes", {0.5, 0.7, 0.6}}});
}

/// Far, the cosine hardly varies.
TEST(TexturedNoise, AtTenSizes) {
    measure(10, 100,
            {{"constant", {1e-3, 1e-3, 1e-3}},
             {"gradient", {0.01, 0.02, 0.01}},
             {"television", {0.01, 0.02, 0.01}},
             {"stained glass", {0.01, 0.02, 0.01}},
             {"spikes", {0.015, 0.02, 0.02}}});
}

/// Lobes of a half width of 0.15 that point somewhere on the light, at about its size from it.
TEST(TexturedNoise, OfGlossySurfaces) {
    constexpr int kSamples = 200;
    constexpr float kWidth = 0.15f;
    const nusselt::Ltc<float> lobe({1 / kWidth, 0, 1 / kWidth, 0, 1, 1});
    const nusselt::Ltc<double> precise({1.0 / kWidth, 0, 1.0 / kWidth, 0, 1, 1});
    const std::vector<NamedTexture>& textures = named_textures();
    const auto lights = lights_for<16>(textures);
    std::vector<Moments> rows(textures.size());
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal(0, 0.3);
    const auto world = nusselt::make_texture_plane<double>({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (int view = 0; view < kViews; ++view) {
        const double x = normal(random), y = normal(random);
        const nusselt::Vec3<double> point =
            nusselt::Vec3<double>{0.5, 0.5, 0} + normalize(nusselt::Vec3<double>{x, y, 1});
        const double aim_x = uniform(random);
        const nusselt::Vec3<double> aim{aim_x, uniform(random), 0};
        const auto frame = nusselt::Frame<double>::from_normal(normalize(aim - point));
        const View plane = to_shading_space(world, point, frame);
        const auto expected = integrals(plane, textures, [&](const auto& wi) { return precise.density(wi); });
        for (std::size_t k = 0; k < textures.size(); ++k) {
            const nusselt::TexturedPolygonLtc<float, 16> technique(converted<float>(plane), lights[k].light,
                                                                   {lobe});
            rows[k].add(expected[k], kSamples,
                        estimates(technique, textures[k], [&](const auto& wi) { return lobe.density(wi); }));
        }
    }
    const std::map<std::string, double> budgets = {
        {"constant", 1e-3}, {"gradient", 0.04}, {"television", 0.2}, {"stained glass", 0.2}, {"spikes", 0.2}};
    for (std::size_t k = 0; k < textures.size(); ++k) {
        report(1, textures[k].name, "16 x 16, lobe", rows[k]);
        EXPECT_LE(rows[k].noise(), budgets.at(textures[k].name)) << textures[k].name;
        expect_unbiased(rows[k], kSamples);
    }
}

} // namespace
} // namespace nusselt_test
