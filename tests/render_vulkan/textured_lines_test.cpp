/// Lines and tubes whose radiance varies along them: the GPU renders the image of the CPU.

#include "emission_test.h"
#include "rich_scene.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace nusselt::render_vulkan_test {
namespace {

using render::EmissionSampling;
using render::Strategies;
using render::Technique;
using render_vulkan::VulkanRenderer;
using scene::LineLight;
using scene::TubeModel;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/// From dark to bright, with stripes in one channel.
scene::EmissionTexture make_texture(int rows) {
    scene::EmissionTexture texture{"texture", 1, rows, {}};
    for (int k = 0; k < rows; ++k) {
        const float x = (static_cast<float>(k) + 0.5f) / static_cast<float>(rows);
        texture.texels.push_back({3 * x * x, 0.2f + x, k / 3 % 2 == 0 ? 2.0f : 0.0f});
    }
    return texture;
}

/// Adds a light with a texture. The mean is a guess: only its ratio to the radiance matters.
void add_light(scene::Scene& scene, int rows, const LineLight& light) {
    render_test::add_line_light(scene, "light", light);
    scene::TexturedEmission emission;
    emission.texture = std::make_shared<const scene::EmissionTexture>(make_texture(rows));
    emission.mean = {1, 0.7f, 1};
    scene.lights.of<LineLight>().back().texture = static_cast<std::int32_t>(scene.emission_textures.size());
    scene.emission_textures.push_back(emission);
}

/// A room without lights.
scene::Scene make_room() {
    scene::Scene scene = make_plain_scene(kWidth, kHeight);
    scene.lights.clear();
    scene.emitters.clear();
    std::fill(scene.triangle_light.begin(), scene.triangle_light.end(), -1);
    return scene;
}

/// A line, and a strip that the camera sees.
scene::Scene make_lines() {
    scene::Scene scene = make_room();
    add_light(scene, 12,
              {.start = {-1.5f, -1, 0.2f},
               .end = {-1.4f, 1, 1.8f},
               .radius = 0.02f,
               .radiance = {20, 15, 10},
               .model = TubeModel::linear});
    add_light(scene, 64,
              {.start = {-0.9f, 1.5f, 1},
               .end = {0.9f, 1.4f, 1.2f},
               .radius = 0.05f,
               .radiance = {20, 10, 30},
               .model = TubeModel::strip,
               .normal = {0, -0.8f, 0.6f}});
    return scene;
}

/// Tubes that the camera sees, with bright and with dark caps.
scene::Scene make_tubes() {
    scene::Scene scene = make_room();
    add_light(scene, 12,
              {.start = {-1, 1, 2}, .end = {1, 1.2f, 2.2f}, .radius = 0.05f, .radiance = {5, 5, 6}});
    add_light(scene, 40,
              {.start = {0.2f, -0.6f, 0.4f},
               .end = {0.3f, -0.5f, 1.7f},
               .radius = 0.12f,
               .radiance = {4, 6, 4},
               .model = TubeModel::open});
    return scene;
}

scene::Scene make_lines_and_tubes() {
    scene::Scene scene = make_lines();
    const scene::Scene tubes = make_tubes();
    for (const LineLight& light : tubes.lights.of<LineLight>()) add_light(scene, 12, light);
    return scene;
}

/// The same scene, but its first light is the other way round.
scene::Scene mutant_of(scene::Scene scene) {
    LineLight& light = scene.lights.of<LineLight>().front();
    std::swap(light.start, light.end);
    return scene;
}

class TexturedLines : public EmissionTest {
protected:
    void expect_agreement(const scene::Scene& scene, const render::RenderSettings& settings) const {
        VulkanRenderer renderer = renderer_of(scene);
        EmissionTest::expect_agreement(renderer, scene, mutant_of(scene), settings);
    }
};

render::RenderSettings centred(EmissionSampling sampling) {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 2;
    settings.strategies = Strategies::diffuse_ltc;
    settings.emission_sampling = sampling;
    return settings;
}

// Each shape and technique makes drivers compile longer.
TEST_F(TexturedLines, WithoutExtent_AgreeWithTheCpu) {
    expect_agreement(make_lines(), centred(EmissionSampling::product));
}

TEST_F(TexturedLines, OfTubes_AgreeWithTheCpu) {
    expect_agreement(make_tubes(), centred(EmissionSampling::product));
}

TEST_F(TexturedLines, SampledByTheirMeasure_AgreeWithTheCpu) {
    render::RenderSettings settings = centred(EmissionSampling::measure);
    settings.technique = Technique::area;
    settings.strategies = Strategies::diffuse;
    expect_agreement(make_lines(), settings);
}

TEST_F(TexturedLines, IntegratedByCells_AgreeWithTheCpu) {
    render::RenderSettings settings = centred(EmissionSampling::product);
    settings.technique = Technique::ltc_analytic;
    settings.strategies = Strategies::diffuse;
    expect_agreement(make_lines_and_tubes(), settings);
}

} // namespace
} // namespace nusselt::render_vulkan_test
