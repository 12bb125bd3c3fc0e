// Environments: the light of the sky on a floor, whichever way it is sampled, and what cameras see of it.

#include "scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace nusselt::render_test {
namespace {

using scene::EnvironmentLight;
using scene::EnvironmentMapTexels;

constexpr int kSize = 16;
constexpr int kMapSize = 32;

render::RenderSettings centred(int samples) {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = samples;
    settings.camera_rays = 1;
    return settings;
}

/// The floor alone, seen from above, below an environment.
scene::Scene make_scene(const EnvironmentLight& light, const EnvironmentMapTexels* map = nullptr) {
    scene::Scene scene = make_floor(kSize);
    set_camera(scene, {0.2f, -0.3f, 1}, {0, 0, 0}, {0, 1, 0}, 0.5, kSize, kSize);
    scene.emitters.push_back({"sky"});
    scene.lights.of<EnvironmentLight>() = {light};
    if (map != nullptr) {
        scene.environment_maps = {std::make_shared<const EnvironmentMapTexels>(*map)};
        scene.lights.of<EnvironmentLight>()[0].map = 0;
        scene.lights.of<EnvironmentLight>()[0].radiance = map->mean;
    }
    return scene;
}

void set_mean(EnvironmentMapTexels& map) {
    double sum[3] = {0, 0, 0};
    for (const Float3& texel : map.texels) {
        sum[0] += texel.x;
        sum[1] += texel.y;
        sum[2] += texel.z;
    }
    const auto count = static_cast<double>(map.texels.size());
    map.mean = {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
                static_cast<float>(sum[2] / count)};
}

/// The unit direction of a point of the square (Clarberg 2008), by the formulas of the paper.
scene::Double3 direction_at(double x, double y) {
    const double u = 2 * x - 1;
    const double v = 2 * y - 1;
    const double d = 1 - std::fabs(u) - std::fabs(v);
    const double r = 1 - std::fabs(d);
    const double angle = r == 0 ? 0 : std::numbers::pi / 4 * ((std::fabs(v) - std::fabs(u)) / r + 1);
    const double across = r * std::sqrt(2 - r * r);
    return {std::copysign(across * std::cos(angle), u), std::copysign(across * std::sin(angle), v),
            std::copysign(1 - r * r, d)};
}

/// Dim, with a bright spot a few texels wide at an elevation of about 40 degrees.
EnvironmentMapTexels make_map() {
    EnvironmentMapTexels map{"map", kMapSize, {}, {}};
    for (int j = 0; j < kMapSize; ++j) {
        for (int i = 0; i < kMapSize; ++i) {
            const scene::Double3 d = direction_at((i + 0.5) / kMapSize, (j + 0.5) / kMapSize);
            const double spot = std::exp(60 * (d.x * 0.6 + d.y * 0.48 + d.z * 0.64 - 1));
            map.texels.push_back({static_cast<float>(0.3 + 0.2 * d.x + 40 * spot),
                                  static_cast<float>(0.3 + 30 * spot),
                                  static_cast<float>(0.5 + 0.3 * d.z + 20 * spot)});
        }
    }
    set_mean(map);
    return map;
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
            const double cosine = direction_at(x, y).z;
            const bool is_inside = std::min({x, y, 1 - x, 1 - y}) > 0.5 / kMapSize;
            if (cosine > 0 && is_inside) sum += cosine * map_at(map, x, y);
        }
    }
    return kFloorAlbedo / std::numbers::pi * 4 * std::numbers::pi * sum / (kPoints * kPoints);
}

struct Mean {
    double value = 0, error = 0;
};

Mean render_green(const scene::Scene& scene, const render::RenderSettings& settings) {
    const image::Image image = render_cpu::Renderer(scene, 2).render(settings, base::choose_isa()).image;
    std::vector<double> values;
    for (std::size_t i = 1; i < image.pixels.size(); i += 3) values.push_back(image.pixels[i]);
    Mean mean;
    const auto count = static_cast<double>(values.size());
    for (const double value : values) mean.value += value / count;
    for (const double value : values)
        mean.error += (value - mean.value) * (value - mean.value) / (count * (count - 1));
    mean.error = std::sqrt(mean.error);
    return mean;
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
    render::RenderSettings settings = centred(64);
    settings.sample_order = render::SampleOrder::independent;
    const Mean mean = render_green(make_scene({}, &map), settings);
    EXPECT_NEAR(mean.value, expected, 5 * mean.error + 2e-4 * expected);
    EXPECT_LT(mean.error, 3e-3 * expected);
    // The test of the test: a map that is turned by five degrees.
    const float c = std::cos(0.0873f), s = std::sin(0.0873f);
    const Mean turned = render_green(make_scene({.x_axis = {c, 0, -s}, .z_axis = {s, 0, c}}, &map), settings);
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
        settings.sample_order = render::SampleOrder::independent;
        const Mean reference = render_green(scene, settings);
        settings.strategies = render::Strategies::diffuse_ltc;
        settings.samples = 256;
        for (const auto mis : render::kMisHeuristics) {
            settings.mis = mis;
            const Mean mean = render_green(scene, settings);
            EXPECT_NEAR(mean.value, reference.value, 5 * std::hypot(mean.error, reference.error))
                << render::name_of(mis) << ", uniform: " << is_uniform;
        }
        // The test of the test: a tenth of the light is missing.
        scene.lights.of<EnvironmentLight>()[0].radiance.y *= 0.9f;
        const Mean mean = render_green(scene, settings);
        EXPECT_GT(std::fabs(mean.value - reference.value), 5 * std::hypot(mean.error, reference.error));
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
        const scene::Double3 d = direction_at(x, y);
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
    const Mean mean = render_green(make_scene({}, &map), centred(4));
    EXPECT_EQ(mean.value, 0);
}

} // namespace
} // namespace nusselt::render_test
