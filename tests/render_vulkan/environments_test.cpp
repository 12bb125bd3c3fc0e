/// Environments: GPUs render the images of the CPU.

#include "emission_test.h"
#include "lab/errors/bias_statistics.h"
#include "rich_scene.h"
#include "scenes.h"

#include "render_vulkan/backend.h"
#include "render_vulkan/lights/light_records.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using render::Strategies;
using render::Technique;
using render_vulkan::VulkanRenderer;
using scene::Float3;

constexpr int kWidth = 32;
constexpr int kHeight = 24;

/// Dark colours, and texels that are much brighter. \param brightness of all of them
std::shared_ptr<const scene::EnvironmentMapTexels> make_map(int size, float brightness) {
    scene::EnvironmentMapTexels map{"map", size, {}, {1, 2, 1}};
    std::uint32_t state = 11;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 16777216.0f;
    };
    for (int i = 0; i < size * size; ++i) {
        const float texel = brightness * (random() < 0.03f ? 30 : random());
        map.texels.push_back({texel * random(), texel, texel * random()});
    }
    return std::make_shared<const scene::EnvironmentMapTexels>(std::move(map));
}

/// A sky with a map, one that is the same everywhere, and one whose map is black. The camera sees them behind the walls.
scene::Scene make_scene(int width, int height) {
    scene::Scene scene = make_plain_scene(width, height);
    // Each kind of light makes drivers compile longer.
    scene.lights.clear();
    scene.emitters.clear();
    std::fill(scene.triangle_light.begin(), scene.triangle_light.end(), -1);
    scene.environment_maps = {make_map(32, 1), make_map(16, 0)};
    const auto add = [&](std::int32_t map, const Float3& radiance) {
        scene::EnvironmentLight light;
        light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
        light.map = map;
        light.radiance = radiance;
        light.y_axis = {0, 0.6f, 0.8f};
        light.z_axis = {0, -0.8f, 0.6f};
        scene.emitters.push_back({"sky"});
        scene.lights.of<scene::EnvironmentLight>().push_back(light);
    };
    add(0, {0.5f, 1, 0.4f});
    add(-1, {0.1f, 0.2f, 0.4f});
    add(1, {1, 1, 1});
    return scene;
}

/// The same scene, but its map is a mirror image.
scene::Scene make_mutant(int width, int height) {
    scene::Scene scene = make_scene(width, height);
    scene.lights.of<scene::EnvironmentLight>().front().x_axis = {-1, 0, 0};
    return scene;
}

render::RenderSettings centred() {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 2;
    return settings;
}

class Environments : public EmissionTest {
protected:
    static void expect_agreement(VulkanRenderer& renderer, const render::RenderSettings& settings) {
        EmissionTest::expect_agreement(renderer, make_scene(kWidth, kHeight), make_mutant(kWidth, kHeight),
                                       settings);
    }
};

TEST_F(Environments, AgreeWithTheCpu_WithAllHeuristics) {
    VulkanRenderer renderer = renderer_of(make_scene(kWidth, kHeight));
    render::RenderSettings settings = centred();
    settings.strategies = Strategies::diffuse_ltc;
    settings.visibility_estimate = 0.8f;
    for (const render::Mis mis : render::kMisHeuristics) {
        settings.mis = mis;
        expect_agreement(renderer, settings);
    }
}

/// They take the same samples with all techniques and strategies without lobes, also by the measure.
TEST_F(Environments, AgreeWithTheCpu_WithoutLobes) {
    VulkanRenderer renderer = renderer_of(make_scene(kWidth, kHeight));
    render::RenderSettings settings = centred();
    settings.technique = Technique::solid_angle;
    settings.strategies = Strategies::diffuse_ggx;
    settings.mis = render::Mis::balance;
    settings.emission_sampling = render::EmissionSampling::measure;
    expect_agreement(renderer, settings);
}

TEST_F(Environments, IntegratedByCells_AgreeWithTheCpu) {
    VulkanRenderer renderer = renderer_of(make_scene(kWidth, kHeight));
    render::RenderSettings settings = centred();
    settings.technique = Technique::ltc_analytic;
    expect_agreement(renderer, settings);
}

/// With random positions in pixels, only means agree.
TEST_F(Environments, HaveNoBias) {
    constexpr int kFrames = 12;
    render::RenderSettings settings;
    settings.strategies = Strategies::diffuse_ltc;
    settings.samples = 8;
    const auto statistics_of = [&](std::uint32_t first_seed, const auto& render) {
        lab::BiasStatistics statistics;
        for (std::uint32_t i = 0; i < kFrames; ++i) {
            settings.seed = first_seed + i;
            statistics.add(render(settings));
        }
        return statistics;
    };
    VulkanRenderer renderer = renderer_of(make_scene(kWidth, kHeight));
    const lab::BiasStatistics of_gpu =
        statistics_of(0, [&](const auto& s) { return renderer.render(s).image; });
    const auto compare = [&](const scene::Scene& other) {
        return of_gpu.compare(statistics_of(1000, [&](const auto& s) { return render_on_cpu(other, s); }));
    };
    const lab::BiasTest test = compare(make_scene(kWidth, kHeight));
    EXPECT_TRUE(test.passes()) << "frame " << test.frame << ", cell " << test.largest_cell << ", chi^2 "
                               << test.chi_square << " of " << test.cells;
    EXPECT_FALSE(compare(make_mutant(kWidth, kHeight)).passes());
    // A map that is a little brighter.
    scene::Scene brighter = make_scene(kWidth, kHeight);
    brighter.lights.of<scene::EnvironmentLight>().front().radiance = {0.52f, 1.04f, 0.416f};
    EXPECT_FALSE(compare(brighter).passes());
}

TEST(EnvironmentRecords, HaveTheWordsOfMaps) {
    render_vulkan::LightRecords records = render_vulkan::make_light_records(make_scene(4, 4));
    EXPECT_EQ(records.polygon_slots, 8) << "the slots of the only shaders for environments";
    EXPECT_EQ(sizeof(std::uint32_t) * records.array_at(interface::kEnvironmentLightsBinding).words.size(),
              3 * sizeof(interface::EnvironmentLightRecord));
    const std::size_t of_texels = 3 * (32 * 32 + 16 * 16);
    EXPECT_GT(records.array_at(interface::kEmissionWordsBinding).words.size(), of_texels);
}

/// Two portals that the camera sees: of a sky with a map, and of one that is the same everywhere.
scene::Scene make_portals(const scene::PolygonVertices& first, const scene::PolygonVertices& second) {
    scene::Scene scene = make_scene(kWidth, kHeight);
    auto& lights = scene.lights.of<scene::EnvironmentLight>();
    lights.resize(2);
    lights[0].portal = first;
    lights[1].portal = second;
    return scene;
}

const scene::PolygonVertices kWindow = {
    {2.1f, -1, 0.4f}, {2.1f, 1.5f, 0.4f}, {2.1f, 1.5f, 2.4f}, {2.1f, -1, 2.4f}};
const scene::PolygonVertices kSkylight = {{-1, 1.8f, 2.6f}, {1, 1.8f, 2.6f}, {0.4f, 0.2f, 3.4f}};
const scene::PolygonVertices kPentagon = {
    {-1, 1.8f, 2.6f}, {1, 1.8f, 2.6f}, {1.2f, 1, 3}, {0.4f, 0.2f, 3.4f}, {-0.4f, 0.2f, 3.4f}};

/// The same scene, but the map behind its first portal is a mirror image.
scene::Scene mirrored(scene::Scene scene) {
    scene.lights.of<scene::EnvironmentLight>().front().x_axis = {-1, 0, 0};
    return scene;
}

/// The same scene, but its last portal is a little smaller.
scene::Scene narrowed(scene::Scene scene) {
    scene::PolygonVertices& portal = scene.lights.of<scene::EnvironmentLight>().back().portal;
    portal[0].x += 0.2f;
    return scene;
}

class Portals : public EmissionTest {
protected:
    static render::RenderSettings measured() {
        render::RenderSettings settings = centred();
        settings.emission_sampling = render::EmissionSampling::measure;
        return settings;
    }
};

TEST_F(Portals, AgreeWithTheCpu) {
    const scene::Scene scene = make_portals(kWindow, kSkylight);
    VulkanRenderer renderer = renderer_of(scene);
    render::RenderSettings settings = measured();
    settings.strategies = Strategies::diffuse_ltc;
    settings.visibility_estimate = 0.8f;
    expect_agreement(renderer, scene, mirrored(scene), settings);
    settings.mis = render::Mis::optimal;
    expect_agreement(renderer, scene, narrowed(scene), settings);
}

/// Without a map and with more than four corners, beside a sky without a portal.
TEST_F(Portals, Integrated_AgreeWithTheCpu) {
    scene::Scene scene = make_portals({}, kPentagon);
    scene.lights.of<scene::EnvironmentLight>().front().map = -1;
    VulkanRenderer renderer = renderer_of(scene);
    render::RenderSettings settings = centred();
    settings.technique = Technique::ltc_analytic;
    expect_agreement(renderer, scene, narrowed(scene), settings);
}

TEST_F(Portals, WithAMap_AreNotIntegrated) {
    const scene::Scene scene = make_portals(kWindow, kSkylight);
    render::RenderSettings settings = centred();
    settings.technique = Technique::ltc_analytic;
    EXPECT_EQ(render_vulkan::why_unsupported(scene, settings),
              "--technique ltc_analytic is not supported on GPUs for portals of environments with a map");
    EXPECT_EQ(render_vulkan::why_unsupported(scene, centred()), std::nullopt);
    VulkanRenderer renderer = renderer_of(scene);
    EXPECT_THROW(renderer.render(settings), std::invalid_argument);
}

/// Without a map, samples by the measure are those by the product.
TEST_F(Portals, WithAMap_HaveAWarningWhereTheyAreSampledByTheirMeasureInPlaceOfProducts) {
    const render_vulkan::VulkanBackend backend({.validation = gpu::Validation::on},
                                               render_vulkan::ShadowRays::none);
    const scene::Scene scene = make_portals(kWindow, kSkylight);
    EXPECT_EQ(backend.warnings(scene, {}),
              std::vector<std::string>{"portals of environments with a map (1) are sampled as with "
                                       "--emission-sampling measure: GPUs have no other samples of them"});
    EXPECT_EQ(backend.warnings(scene, measured()), std::vector<std::string>());
    EXPECT_EQ(backend.warnings(make_portals({}, kSkylight), {}), std::vector<std::string>());
}

TEST(EnvironmentRecords, HaveRoomForTheCornersOfPortals) {
    const auto expect_room = [](const scene::PolygonVertices& first, const scene::PolygonVertices& second,
                                int slots, std::size_t portals) {
        render_vulkan::LightRecords records = render_vulkan::make_light_records(make_portals(first, second));
        EXPECT_EQ(records.polygon_slots, slots);
        const std::size_t polygons = make_portals({}, {}).lights.of<scene::PolygonLight>().size();
        EXPECT_EQ(records.array_at(interface::kPolygonCornersBinding).words.size(),
                  1 + (polygons + portals) * 6 * static_cast<std::size_t>(slots))
            << "one in an empty array";
    };
    expect_room(kWindow, kSkylight, 4, 2);
    expect_room(kWindow, kPentagon, 8, 2);
    // The slots of the only shaders for environments without a portal.
    expect_room({}, kSkylight, 8, 1);
}

} // namespace
} // namespace nusselt::render_vulkan_test
