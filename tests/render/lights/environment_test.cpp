// Environments: the light of the sky on a floor, whichever way it is sampled, and what cameras see of it.

#include "lights/sky_scenes.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace nusselt::render_test {
namespace {

using scene::EnvironmentLight;
using scene::EnvironmentMapTexels;

constexpr int kMapSize = 32;

/// The floor alone, seen from above, below an environment.
scene::Scene make_scene(const EnvironmentLight& light, const EnvironmentMapTexels* map = nullptr) {
    scene::Scene scene = make_floor(kSkyPixels);
    set_camera(scene, {0.2f, -0.3f, 1}, {0, 0, 0}, {0, 1, 0}, 0.5, kSkyPixels, kSkyPixels);
    add_sky(scene, light, map);
    return scene;
}

/// Dim, with a bright spot a few texels wide at an elevation of about 40 degrees.
EnvironmentMapTexels make_map() {
    return make_sky_map(kMapSize, [](const scene::Double3& d) {
        const double spot = std::exp(60 * (d.x * 0.6 + d.y * 0.48 + d.z * 0.64 - 1));
        return Float3{static_cast<float>(0.3 + 0.2 * d.x + 40 * spot), static_cast<float>(0.3 + 30 * spot),
                      static_cast<float>(0.5 + 0.3 * d.z + 20 * spot)};
    });
}

/// The interpolated map at a point of the square that is not within half a texel of its edges.
double map_at(const EnvironmentMapTexels& map, double x, double y) {
    const double u = x * map.size - 0.5;
    const double v = y * map.size - 0.5;
    const int i = static_cast<int>(u);
    const int j = static_cast<int>(v);
    const auto at = [&](int column, int row) {
        return double{map.texels[static_cast<std::size_t>(row * map.size + column)].y};
    };
    return (1 - (v - j)) * ((1 - (u - i)) * at(i, j) + (u - i) * at(i + 1, j)) +
           (v - j) * ((1 - (u - i)) * at(i, j + 1) + (u - i) * at(i + 1, j + 1));
}

/// The green light that the floor reflects, by the midpoint rule. The upper hemisphere is within the square.
double floor_radiance(const EnvironmentMapTexels& map) {
    constexpr int kPoints = 1024;
    double sum = 0;
    for (int j = 0; j < kPoints; ++j) {
        for (int i = 0; i < kPoints; ++i) {
            const double x = (i + 0.5) / kPoints;
            const double y = (j + 0.5) / kPoints;
            const double cosine = square_direction(x, y).z;
            const bool is_inside = std::min({x, y, 1 - x, 1 - y}) > 0.5 / kMapSize;
            if (cosine > 0 && is_inside) sum += cosine * map_at(map, x, y);
        }
    }
    return kFloorAlbedo / std::numbers::pi * 4 * std::numbers::pi * sum / (kPoints * kPoints);
}

TEST(UniformSky, LightsAFloorWithoutNoise) {
    const scene::Scene scene = make_scene({.radiance = {1, 2, 3}});
    for (const auto technique : {render::Technique::projected_solid_angle, render::Technique::area,
                                 render::Technique::ltc_analytic}) {
        render::RenderSettings settings = centred(1);
        settings.technique = technique;
        const image::Image image = render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
            EXPECT_NEAR(image.pixels[i], kFloorAlbedo, 2e-6);
            EXPECT_NEAR(image.pixels[i + 1], 2 * kFloorAlbedo, 4e-6);
            EXPECT_NEAR(image.pixels[i + 2], 3 * kFloorAlbedo, 6e-6);
        }
    }
}

TEST(SkyWithMap, LightsAFloorLikeQuadrature) {
    const EnvironmentMapTexels map = make_map();
    const double expected = floor_radiance(map);
    const render::RenderSettings settings = centred(64);
    const PixelMean mean = render_green(make_scene({}, &map), settings);
    EXPECT_NEAR(mean.value, expected, 5 * mean.error + 2e-4 * expected);
    EXPECT_LT(mean.error, 3e-3 * expected);
    // The test of the test: a map that is turned by five degrees.
    const float c = std::cos(0.0873f), s = std::sin(0.0873f);
    const PixelMean turned =
        render_green(make_scene({.x_axis = {c, 0, -s}, .z_axis = {s, 0, c}}, &map), settings);
    EXPECT_GT(std::fabs(turned.value - expected), 5 * turned.error + 2e-4 * expected);
}

/// All strategies on a glossy floor agree with samples by the cosine, which know no lobe.
TEST(SkyWithMap, AllStrategiesHaveTheSameExpectation) {
    const EnvironmentMapTexels map = make_map();
    for (const bool is_uniform : {false, true}) {
        scene::Scene scene = is_uniform ? make_scene({.radiance = {1, 2, 3}}) : make_scene({}, &map);
        scene.materials[0].model = scene::BrdfModel::frostbite;
        scene.materials[0].f0 = {0.2f, 0.2f, 0.2f};
        scene.materials[0].roughness = 0.5f;
        // The floor is the same in all pixels of a parallel projection.
        scene.camera.origin_right = scene.camera.right;
        scene.camera.right = {0, 0, 0};
        scene.camera.origin_down = scene.camera.down;
        scene.camera.down = {0, 0, 0};
        scene.camera.corner = {-0.3f, 0.2f, -1};
        render::RenderSettings settings = centred(1024);
        const PixelMean reference = render_green(scene, settings);
        settings.strategies = render::Strategies::diffuse_ltc;
        settings.samples = 256;
        for (const auto mis : render::kMisHeuristics) {
            settings.mis = mis;
            EXPECT_TRUE(agree(render_green(scene, settings), reference))
                << render::name_of(mis) << ", uniform: " << is_uniform;
        }
        // The test of the test: a tenth of the light is missing.
        scene.lights.of<EnvironmentLight>()[0].radiance.y *= 0.9f;
        EXPECT_FALSE(agree(render_green(scene, settings), reference));
    }
}

TEST(SkyWithMap, CamerasSeeItBehindEverything) {
    const EnvironmentMapTexels map = make_map();
    scene::Scene scene = make_scene({}, &map);
    const auto seen = [&](const Float3& target, render::LayerKind layer) {
        set_camera(scene, {0, 0, 1}, target, {0, 1, 0}, 1e-4, 1, 1);
        render::RenderSettings settings = centred(1);
        settings.layers = {layer};
        return render_cpu::Renderer(scene, 1).render(settings, base::choose_isa());
    };
    for (const auto& [x, y] : {std::pair(0.6, 0.7), std::pair(0.4, 0.3), std::pair(0.55, 0.45)}) {
        const scene::Double3 d = square_direction(x, y);
        const auto result =
            seen({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z + 1)},
                 render::LayerKind::lights);
        EXPECT_NEAR(result.image.pixels[1], map_at(map, x, y), 1e-3 * map_at(map, x, y)) << x << " " << y;
    }
}

TEST(SkyWithMap, BlackMapsAreBlack) {
    EnvironmentMapTexels map = make_map();
    for (Float3& texel : map.texels) texel.y = 0;
    set_mean(map);
    const PixelMean mean = render_green(make_scene({}, &map), centred(4));
    EXPECT_EQ(mean.value, 0);
}

} // namespace
} // namespace nusselt::render_test
