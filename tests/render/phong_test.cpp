/// Phong surfaces: their radiance against quadrature of the textbook formula, and the mean of all estimators.

#include "line_scenes.h"

#include <nusselt/core/vec.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace nusselt::render_test {
namespace {

using render::RenderSettings;

constexpr float kRadiance = 5;
constexpr float kDiffuse = 0.3f;
constexpr float kSpecular = 0.5f;

/// In the mirrored direction of the middle of the floor.
const std::array<Float3, 4> kPanel = {Float3{-0.5f, 0.7f, 0.8f}, Float3{-0.5f, 1.5f, 1.1f},
                                      Float3{0.6f, 1.5f, 1.1f}, Float3{0.6f, 0.7f, 0.8f}};

/// A floor that fills the image, below a panel, with an occluder in between on demand.
scene::Scene make_phong_scene(float exponent, int size) {
    scene::Scene scene;
    scene.materials.push_back({.name = "floor",
                               .model = scene::BrdfModel::phong,
                               .diffuse = {kDiffuse, kDiffuse, kDiffuse},
                               .f0 = {kSpecular, kSpecular, kSpecular},
                               .exponent = exponent});
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_quad(scene, {Float3{-4, -4, 0}, Float3{4, -4, 0}, Float3{4, 4, 0}, Float3{-4, 4, 0}}, 0);
    add_polygon_light(scene, kPanel, {kRadiance, kRadiance, kRadiance}, false, 1);
    set_camera(scene, {0, -1.4f, 1.2f}, {0, 0, 0}, {0, 0, 1}, 0.3, size, size);
    set_radius(scene);
    return scene;
}

scene::Scene with_occluder(scene::Scene scene) {
    add_quad(scene,
             {Float3{-0.2f, 0.2f, 0.5f}, Float3{0.3f, 0.25f, 0.5f}, Float3{0.3f, 0.5f, 0.6f},
              Float3{-0.2f, 0.5f, 0.6f}},
             1);
    set_radius(scene);
    return scene;
}

/// The radiance of the pixel (x, y) by quadrature over the panel.
double expected_radiance(const scene::Scene& scene, double exponent, int x, int y) {
    const auto vec = [](const Float3& v) { return Vec3<double>{v.x, v.y, v.z}; };
    const scene::Camera& camera = scene.camera;
    const Vec3<double> direction =
        normalize(vec(camera.corner) + (x + 0.5) * vec(camera.right) + (y + 0.5) * vec(camera.down));
    const Vec3<double> eye = vec(camera.origin);
    const Vec3<double> point = eye + (-eye.z / direction.z) * direction;
    const Vec3<double> mirror{direction.x, direction.y, -direction.z};
    const Vec3<double> across = vec(kPanel[3]) - vec(kPanel[0]);
    const Vec3<double> up = vec(kPanel[1]) - vec(kPanel[0]);
    const Vec3<double> area = cross(across, up);
    constexpr int kNodes = 200;
    const double pi = std::acos(-1.0);
    double sum = 0;
    for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kNodes; ++j) {
            const Vec3<double> to_light =
                vec(kPanel[0]) + ((i + 0.5) / kNodes) * across + ((j + 0.5) / kNodes) * up - point;
            const double squared = dot(to_light, to_light);
            const Vec3<double> wi = (1 / std::sqrt(squared)) * to_light;
            const double power = std::pow(std::max(dot(wi, mirror), 0.0), exponent);
            const double brdf = double{kDiffuse} / pi + double{kSpecular} * (exponent + 2) / (2 * pi) * power;
            sum += brdf * wi.z * std::fabs(dot(area, wi)) / squared;
        }
    return double{kRadiance} * sum / (kNodes * kNodes);
}

class PhongSurface : public testing::TestWithParam<float> {};

/// Lines shade Phong surfaces in closed form, whichever shading is asked for.
TEST_P(PhongSurface, LinesHaveTheRadianceOfQuadrature) {
    constexpr int kImage = 8;
    const scene::Scene scene = make_phong_scene(GetParam(), kImage);
    const render_cpu::Renderer renderer(scene, 2);
    for (const auto shading : {render::LineShading::analytic, render::LineShading::unbiased}) {
        RenderSettings settings = line_settings(512);
        settings.lines.shading = shading;
        settings.sample_order = render::SampleOrder::stratified;
        const image::Image image = renderer.render(settings, base::choose_isa()).image;
        for (int y = 0; y < kImage; ++y)
            for (int x = 0; x < kImage; ++x) {
                const double expected = expected_radiance(scene, double{GetParam()}, x, y);
                EXPECT_NEAR(image.pixels[3 * static_cast<std::size_t>(y * kImage + x)], expected,
                            2e-3 * expected)
                    << x << ", " << y;
            }
    }
}

/// Points of the area, which need the BRDF alone; many of them, as few meet narrow lobes.
std::vector<std::vector<double>> reference(const scene::Scene& scene) {
    const render_cpu::Renderer renderer(scene, 2);
    RenderSettings settings = point_settings();
    settings.technique = render::Technique::area;
    settings.samples = 2048;
    return render_region_means(renderer, settings, kSeeds, renderer.visibility().tracer());
}

double difference(const scene::Scene& scene, const RenderSettings& settings,
                  const std::vector<std::vector<double>>& expected) {
    const render_cpu::Renderer renderer(scene, 2);
    return largest_t(render_region_means(renderer, settings, kSeeds, renderer.visibility().tracer()),
                     expected);
}

TEST_P(PhongSurface, AllEstimatorsHaveTheMeanOfPointsOfTheArea) {
    const scene::Scene scene = with_occluder(make_phong_scene(GetParam(), 2 * kRegionsPerAxis));
    const auto expected = reference(scene);
    for (const auto strategies : {render::Strategies::diffuse, render::Strategies::diffuse_ltc,
                                  render::Strategies::diffuse_ggx, render::Strategies::diffuse_ggx_bounded}) {
        RenderSettings settings = point_settings();
        settings.strategies = strategies;
        settings.mis = render::Mis::balance;
        // Few samples of the BRDF meet the light from where the lobe just misses it.
        settings.samples = 1024;
        EXPECT_LT(difference(scene, settings, expected), kLargestT) << name_of(strategies);
    }
    for (const auto mis : render::kMisHeuristics) {
        RenderSettings settings = point_settings();
        settings.strategies = render::Strategies::diffuse_ltc;
        settings.mis = mis;
        EXPECT_LT(difference(scene, settings, expected), kLargestT) << name_of(mis);
    }
    for (const auto offsets : render::kLineOffsets) {
        RenderSettings settings = line_settings(4);
        settings.lines.offsets = offsets;
        EXPECT_LT(difference(scene, settings, expected), kLargestT) << name_of(offsets);
    }
}

/// The tests of the test: a lobe that is a tenth wider or brighter.
TEST_P(PhongSurface, OtherLobesAreNoticed) {
    const scene::Scene scene = with_occluder(make_phong_scene(GetParam(), 2 * kRegionsPerAxis));
    const auto expected = reference(scene);
    scene::Scene wider = scene;
    wider.materials[0].exponent = 0.8f * GetParam();
    scene::Scene brighter = scene;
    brighter.materials[0].f0 = {1.1f * kSpecular, 1.1f * kSpecular, 1.1f * kSpecular};
    const RenderSettings settings = line_settings(4);
    EXPECT_GT(difference(wider, settings, expected), kLargestT);
    EXPECT_GT(difference(brighter, settings, expected), kLargestT);
}

INSTANTIATE_TEST_SUITE_P(Exponents, PhongSurface, testing::Values(5.0f, 60.0f, 700.0f),
                         [](const auto& exponent) {
                             return std::to_string(static_cast<int>(exponent.param));
                         });

/// Where the lobe is a millionth of the light, and its tails have no light at all, tables of offsets must not miss it.
TEST(NarrowPhongSurface, ReflectsHugeLights) {
    for (const float half : {90.0f, 150.0f, 900.0f}) {
        scene::Scene scene;
        scene.materials.push_back({.name = "mirror",
                                   .model = scene::BrdfModel::phong,
                                   .diffuse = {0, 0, 0},
                                   .f0 = {1, 1, 1},
                                   .exponent = 1e6f});
        add_quad(scene, {Float3{-9, -9, 0}, Float3{9, -9, 0}, Float3{9, 9, 0}, Float3{-9, 9, 0}}, 0);
        add_polygon_light(
            scene,
            {Float3{-half, -half, 1}, Float3{-half, half, 1}, Float3{half, half, 1}, Float3{half, -half, 1}},
            {kRadiance, kRadiance, kRadiance}, true, 0);
        set_camera(scene, {0, 0, 0.9f}, {0, 0, 0}, {0, 1, 0}, 0.05, 16, 16);
        set_radius(scene);
        const image::Image image =
            render_cpu::Renderer(scene, 2).render(line_settings(128), base::choose_isa()).image;
        const double sum = std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
        EXPECT_NEAR(sum / static_cast<double>(image.pixels.size()), kRadiance, 0.05 * kRadiance) << half;
        EXPECT_LT(*std::max_element(image.pixels.begin(), image.pixels.end()), 3 * kRadiance) << half;
    }
}

} // namespace
} // namespace nusselt::render_test
