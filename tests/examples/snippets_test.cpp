#include "common/source_folder.h"
#include "examples/snippets/snippets.cpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace {

// Above the origin, half in front of it.
const Vec kCorners[] = {{-0.5f, -0.4f, 1}, {1, -0.4f, 1.2f}, {1, 0.6f, 1.2f}, {-0.5f, 0.6f, 1}};
const Vec3<double> kCornersInDouble[] = {{kCorners[0].x, kCorners[0].y, kCorners[0].z},
                                         {kCorners[1].x, kCorners[1].y, kCorners[1].z},
                                         {kCorners[2].x, kCorners[2].y, kCorners[2].z},
                                         {kCorners[3].x, kCorners[3].y, kCorners[3].z}};
constexpr float kEmitted = 3;

/// Radiance that a Lambertian surface at the origin reflects: albedo / pi times projected solid angle.
float reflected(const Vec& normal) {
    const auto local =
        to_shading_space(make_polygon<4>(kCorners, 4), Vec{0, 0, 0}, Frame<float>::from_normal(normal));
    return kEmitted * kAlbedo / kPi<float> * projected_solid_angle(local);
}

TEST(Snippets, ReadmeGivesTheClosedFormForEverySample) {
    for (const Vec& normal : {Vec{0, 0, 1}, normalize(Vec{1, 0, 0.2f})})
        for (const float u : {0.0f, 0.3f, 0.99f})
            EXPECT_NEAR(direct_light(kCorners, {0, 0, 0}, normal, kEmitted, brdf, u, 1 - u - 0.001f),
                        reflected(normal), 1e-5f);
}

TEST(Snippets, ReadmeWorksWithVectorsAsColours) {
    const Vec emitted{3, 6, 1.5f};
    const Vec radiance = direct_light(kCorners, {0, 0, 0}, {0, 0, 1}, emitted, coloured_brdf, 0.3f, 0.6f);
    const float grey = reflected({0, 0, 1}) / (kEmitted * kAlbedo);
    EXPECT_NEAR(radiance.x, emitted.x * kColouredAlbedo.x * grey, 1e-5f);
    EXPECT_NEAR(radiance.y, emitted.y * kColouredAlbedo.y * grey, 1e-5f);
    EXPECT_NEAR(radiance.z, emitted.z * kColouredAlbedo.z * grey, 1e-5f);
}

TEST(Snippets, MultipleImportanceSamplingIsUnbiased) {
    const auto light = make_polygon<4>(kCorners, 4);
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<float> uniform(0, 0.999999f);
    constexpr int kCount = 100000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kCount; ++i) {
        const float u0 = uniform(engine), u1 = uniform(engine), v0 = uniform(engine), v1 = uniform(engine);
        const double x = direct_light_mis(light, {0, 0, 0}, {0, 0, 1}, kEmitted, {u0, u1}, {v0, v1});
        sum += x;
        squares += x * x;
    }
    const double mean = sum / kCount;
    const double standard_error = std::sqrt((squares / kCount - mean * mean) / kCount);
    EXPECT_NEAR(mean, reflected({0, 0, 1}), 4 * standard_error);
    EXPECT_LT(standard_error, 0.003 * mean);
}

Lobes shipped_lobes() {
    std::ifstream file(std::filesystem::path(nusselt_test::kSourceFolder) / "data/ltc-frostbite.bin",
                       std::ios::binary);
    return load_lobes({std::istreambuf_iterator<char>(file), {}});
}

TEST(Snippets, GlossyLightIsUnbiased) {
    const Lobes lobes = shipped_lobes();
    const auto light = make_polygon<4>(kCorners, 4);
    const SurfacePoint<float> point{
        {0, 0, 0}, {0, 0, 1}, normalize(Vec{-1, 0.2f, 1}), {0.3f, 0.3f, 0.3f}, {0.04f, 0.04f, 0.04f}, 0.3f};

    // Midpoints of a fine grid on the light, in world space.
    const Frostbite<double> brdf({point.wo.x, point.wo.y, point.wo.z}, {0.3, 0.3, 0.3}, {0.04, 0.04, 0.04},
                                 0.3);
    const PolygonArea<double, 4> area(make_polygon<4>(kCornersInDouble, 4));
    constexpr int kGrid = 1000;
    double expected = 0;
    for (int i = 0; i < kGrid * kGrid; ++i) {
        const auto s = area.sample({(i % kGrid + 0.5) / kGrid, (i / kGrid + 0.5) / kGrid});
        expected += kEmitted * brdf.eval(s.wi).x * s.wi.z / s.pdf / (kGrid * kGrid);
    }

    std::mt19937_64 engine(1);
    std::uniform_real_distribution<float> uniform(0, 0.999999f);
    constexpr int kCount = 100000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kCount; ++i) {
        const Vec2<float> u[2] = {{uniform(engine), uniform(engine)}, {uniform(engine), uniform(engine)}};
        const double x = glossy_direct_light(light, point, lobes.view, kEmitted, u);
        sum += x;
        squares += x * x;
    }
    const double mean = sum / kCount;
    const double standard_error = std::sqrt((squares / kCount - mean * mean) / kCount);
    EXPECT_NEAR(mean, expected, 4 * standard_error + 1e-5 * expected);
    EXPECT_LT(standard_error, 1e-3 * mean);
}

TEST(Snippets, LobesGiveTheClosedFormForEverySample) {
    const Lobes lobes = shipped_lobes();
    const auto light = make_polygon<4>(kCorners, 4);
    const Vec point{0.1f, 0.2f, 0}, normal{0, 0, 1}, wo = normalize(Vec{-1, 0.2f, 1});
    const auto coefficients = lobes.view.lookup(0.4f, wo.z, 0.04f);
    const auto local = to_shading_space(light, point, shading_frame(normal, wo));
    const float expected = kEmitted * coefficients.albedo * lobe_integral(local, Ltc<float>(coefficients));
    EXPECT_GT(expected, 0);
    for (const float u : {0.0f, 0.3f, 0.99f})
        EXPECT_NEAR(
            light_in_lobe(light, point, normal, wo, 0.4f, 0.04f, lobes.view, kEmitted, {u, 1 - u - 0.001f}),
            expected, 1e-4f * expected);
}

TEST(Snippets, PacksAgreeWithTheClosedForm) {
    const auto light = make_polygon<4>(kCorners, 4);
    float u0[8], u1[8], areas[8], x[8];
    for (int i = 0; i < 8; ++i) {
        u0[i] = 0.12f * static_cast<float>(i);
        u1[i] = 0.9f - 0.1f * static_cast<float>(i);
        x[i] = 0.5f * static_cast<float>(i) - 2;
    }
    EXPECT_NEAR(mean_of_samples(light, u0, u1), projected_solid_angle(light), 1e-5f);

    using Real = Pack<float, 8>;
    const auto up = Frame<Real>::from_normal({Real(0), Real(0), Real(1)});
    projected_solid_angles(light, {Real::load(x), Real(0), Real(0)}, up, areas);
    for (int i = 0; i < 8; ++i) {
        const auto local = to_shading_space(light, Vec{x[i], 0, 0}, Frame<float>::from_normal(Vec{0, 0, 1}));
        EXPECT_NEAR(areas[i], projected_solid_angle(local), 1e-5f);
    }
}

/// Albedo / pi times the integral over the visible part of the light, by midpoints.
double reflected_under(const std::vector<std::array<Vec, 3>>& triangles) {
    const Vec u = kCorners[1] - kCorners[0], v = kCorners[3] - kCorners[0];
    const Vec area = cross(u, v);
    constexpr int kSteps = 800;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const Vec p = kCorners[0] + (static_cast<float>(i) + 0.5f) / kSteps * u +
                          (static_cast<float>(j) + 0.5f) / kSteps * v;
            bool is_visible = true;
            for (const auto& t : triangles) {
                const float a = dot(p, cross(t[0], t[1])), b = dot(p, cross(t[1], t[2])),
                            c = dot(p, cross(t[2], t[0]));
                is_visible = is_visible && !((a > 0) == (b > 0) && (b > 0) == (c > 0));
            }
            const double squared = dot(p, p);
            if (is_visible) sum += p.z * std::fabs(dot(p, area)) / (squared * squared);
        }
    return kEmitted * kAlbedo / kPi<double> * sum / (kSteps * kSteps);
}

TEST(Snippets, LinesAgreeWithAreaSampling) {
    const auto light = make_polygon<4>(kCorners, 4);
    std::vector<float> u(4096);
    for (std::size_t i = 0; i < u.size(); ++i)
        u[i] = (static_cast<float>(i) + 0.5f) / static_cast<float>(u.size());
    std::vector<std::array<Vec, 3>> triangles;
    const double whole = reflected_under(triangles);
    for (int count = 0; count < 3; ++count) {
        const double expected = reflected_under(triangles);
        EXPECT_NEAR(light_of_lines(light, triangles, {0, 0, 0}, {0, 0, 1}, kEmitted, u), expected,
                    2e-3 * whole)
            << count;
        const float x = 0.4f * static_cast<float>(count);
        triangles.push_back({Vec{x, 0.1f, 0.6f}, Vec{x - 0.15f, -0.1f, 0.5f}, Vec{x + 0.1f, -0.1f, 0.55f}});
    }
    EXPECT_LT(reflected_under(triangles), 0.95 * whole);
}

TEST(Snippets, TubeOverhead) {
    // An endless tube at the height h: 2 R / h times the integral of cos^2, which is pi / 2.
    const auto tube = make_line(Vec{-1e4f, 0, 0.5f}, Vec{1e4f, 0, 0.5f});
    EXPECT_NEAR(irradiance(tube, 2, {0, 0, 0}, {0, 0, 1}), 2 * kPi<float> / 0.5f, 1e-3f);
}

} // namespace
