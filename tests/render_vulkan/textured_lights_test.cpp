/// Lights that emit an image: with samples by the measure, the GPU renders the image of the CPU; cells have the same mean.

#include "emission_test.h"
#include "lab/errors/bias_statistics.h"
#include "rich_scene.h"
#include "scenes.h"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using render::EmissionSampling;
using render::Strategies;
using render::Technique;
using render_vulkan::VulkanRenderer;
using scene::Float2;
using scene::Float3;

constexpr int kWidth = 32;
constexpr int kHeight = 24;
constexpr float kBright = 30;

/// Dark colours, and texels that are much brighter.
scene::EmissionTexture make_texture(int width, int height) {
    scene::EmissionTexture texture{"texture", width, height, {}};
    std::uint32_t state = 5;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 16777216.0f;
    };
    for (int i = 0; i < width * height; ++i) {
        const float brightness = random() < 0.03f ? kBright : random();
        texture.texels.push_back({brightness * random(), brightness, brightness * random()});
    }
    return texture;
}

/// Gives a light a texture. The mean is a guess: only its ratio to the radiance matters.
void set_texture(scene::Scene& scene, scene::PolygonLight& light, const scene::EmissionTexture& texture,
                 std::span<const Float2> coordinates) {
    scene::TexturedEmission emission;
    emission.texture = std::make_shared<const scene::EmissionTexture>(texture);
    std::copy(coordinates.begin(), coordinates.end(), emission.coordinates.begin());
    emission.mean = {1, 2, 1};
    light.texture = static_cast<std::int32_t>(scene.emission_textures.size());
    scene.emission_textures.push_back(emission);
}

/// A panel and a triangle with images, which the camera sees, and a uniform light.
scene::Scene make_scene(int width, int height) {
    scene::Scene scene = make_plain_scene(width, height);
    // Each kind of light makes drivers compile longer.
    scene.lights.of<scene::LineLight>().clear();
    auto& lights = scene.lights.of<scene::PolygonLight>();
    const std::array<Float2, 4> of_panel = {{{0.1f, 0.05f}, {0.1f, 0.9f}, {1, 0.9f}, {1, 0.05f}}};
    set_texture(scene, lights.at(0), make_texture(24, 16), of_panel);
    const Float3 corners[] = {{-1.2f, 1.6f, 0.4f}, {-0.2f, 1.6f, 0.4f}, {-0.7f, 1.6f, 1.6f}};
    scene::PolygonLight triangle;
    triangle.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({"triangle"});
    triangle.vertices = {corners[0], corners[1], corners[2]};
    triangle.radiance = {2, 3, 1};
    triangle.two_sided = true;
    lights.push_back(triangle);
    const std::array<Float2, 3> of_triangle = {{{0, 0}, {1, 0.1f}, {0.4f, 1}}};
    set_texture(scene, lights.back(), make_texture(9, 40), of_triangle);
    return scene;
}

/// The same scene, but the image of its panel is upside down.
scene::Scene make_mutant(int width, int height) {
    scene::Scene scene = make_scene(width, height);
    for (Float2& at : scene.emission_textures.at(0).coordinates) at.y = 0.95f - at.y;
    return scene;
}

/// Those that a pair of techniques allows; one is enough where there is no pair.
std::vector<render::Mis> heuristics_of(Strategies strategies) {
    std::vector<render::Mis> all;
    for (const render::Mis mis : render::kMisHeuristics)
        if (allows(strategies, mis) && (strategies != Strategies::diffuse || all.empty())) all.push_back(mis);
    return all;
}

class TexturedLights : public EmissionTest {
protected:
    static void expect_agreement(VulkanRenderer& renderer, const render::RenderSettings& settings) {
        EmissionTest::expect_agreement(renderer, make_scene(kWidth, kHeight), make_mutant(kWidth, kHeight),
                                       settings);
    }
};

render::RenderSettings centred() {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 2;
    settings.emission_sampling = EmissionSampling::measure;
    return settings;
}

TEST_F(TexturedLights, SampledByTheirMeasure_AgreeWithTheCpu) {
    VulkanRenderer renderer = renderer_of(make_scene(kWidth, kHeight));
    render::RenderSettings settings = centred();
    for (const Strategies strategies : render::kStrategies) {
        settings.strategies = strategies;
        // Samples of the BRDF never come from cells.
        settings.emission_sampling =
            strategies == Strategies::diffuse_ggx ? EmissionSampling::product : EmissionSampling::measure;
        for (const render::Mis mis : heuristics_of(strategies)) {
            settings.mis = mis;
            expect_agreement(renderer, settings);
        }
    }
}

TEST_F(TexturedLights, IntegratedByCells_AgreeWithTheCpu) {
    VulkanRenderer renderer = renderer_of(make_scene(kWidth, kHeight));
    render::RenderSettings settings = centred();
    settings.technique = Technique::ltc_analytic;
    expect_agreement(renderer, settings);
}

/// Statistics of frames with these seeds.
lab::BiasStatistics
statistics_of(render::RenderSettings settings, std::uint32_t first_seed, std::uint32_t frames,
              const std::function<image::Image(const render::RenderSettings&)>& make_image) {
    lab::BiasStatistics statistics;
    for (std::uint32_t i = 0; i < frames; ++i) {
        settings.seed = first_seed + i;
        statistics.add(make_image(settings));
    }
    return statistics;
}

/// The CPU descends to texels by their radiance alone, so that only means agree.
TEST_F(TexturedLights, SampledByCells_HaveNoBias) {
    constexpr std::uint32_t kFrames = 16;
    constexpr int kSide = 32;
    render::RenderSettings settings;
    settings.strategies = Strategies::diffuse_ltc;
    // All pixels of a frame share their offset: with few frames, edges would not be independent of each other.
    settings.samples = 16;
    const scene::Scene scene = make_scene(kSide, kSide);
    VulkanRenderer renderer = renderer_of(scene);
    const lab::BiasStatistics of_gpu =
        statistics_of(settings, 0, kFrames, [&](const auto& s) { return renderer.render(s).image; });
    const auto compare = [&](const scene::Scene& other) {
        return of_gpu.compare(
            statistics_of(settings, 1000, kFrames, [&](const auto& s) { return render_on_cpu(other, s); }));
    };
    const lab::BiasTest test = compare(scene);
    EXPECT_TRUE(test.passes()) << "frame " << test.frame << ", cell " << test.largest_cell << ", chi^2 "
                               << test.chi_square << " of " << test.cells;
    EXPECT_FALSE(compare(make_mutant(kSide, kSide)).passes());
    // An image that is a little brighter.
    scene::Scene brighter = make_scene(kSide, kSide);
    brighter.emission_textures.at(0).mean = {0.97f, 1.94f, 0.97f};
    EXPECT_FALSE(compare(brighter).passes());
}

} // namespace
} // namespace nusselt::render_vulkan_test
