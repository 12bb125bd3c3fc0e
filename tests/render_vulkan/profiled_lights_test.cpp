/// Polygonal lights whose radiance depends on the direction: the GPU renders the image of the CPU.

#include "emission_test.h"
#include "render_vulkan/backend.h"
#include "rich_scene.h"
#include "scene/model/profiles/emission_profile.h"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace nusselt::render_vulkan_test {
namespace {

using render::EmissionSampling;
using render::Strategies;
using render::Technique;
using render_vulkan::VulkanRenderer;
using scene::Float3;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/// Gives a light a profile. \param light that has its radiance and vertices
void set_profile(scene::Scene& scene, scene::PolygonLight& light, const scene::ProfileRequest& request) {
    const auto shape = scene::profile_shape(std::span(&light, 1), 0, request);
    light.profile = static_cast<std::int32_t>(scene.emission_profiles.size());
    scene.emission_profiles.push_back(shape->emissions.at(0));
}

/// A triangle in front of the wall.
scene::PolygonLight make_triangle(scene::Scene& scene, float left) {
    scene::PolygonLight triangle;
    triangle.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({"triangle"});
    triangle.vertices = {Float3{left, 1.6f, 0.4f}, Float3{left + 1, 1.6f, 0.4f},
                         Float3{left + 0.5f, 1.6f, 1.6f}};
    triangle.radiance = {2, 3, 1};
    triangle.two_sided = true;
    return triangle;
}

/// A panel that shines as a luminaire, and triangles with a spread and with a honeycomb, which the camera sees.
scene::Scene make_polygon_scene(int width, int height, double angle, double holes = 100) {
    scene::Scene scene = make_plain_scene(width, height);
    // Each kind of light makes drivers compile longer.
    scene.lights.of<scene::LineLight>().clear();
    auto& lights = scene.lights.of<scene::PolygonLight>();
    lights.resize(1);
    set_profile(scene, lights[0], {make_luminaire(), 150, angle});
    scene::PolygonLight spread = make_triangle(scene, -1.2f);
    set_profile(scene, spread, {nullptr, 100, 0});
    lights.push_back(spread);
    scene::PolygonLight honeycomb = make_triangle(scene, 0.1f);
    set_profile(scene, honeycomb, {nullptr, scene::kWidestSpread, 0, {holes, 140}});
    lights.push_back(honeycomb);
    return scene;
}

class ProfiledLights : public EmissionTest {};

render::RenderSettings centred() {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 2;
    settings.emission_sampling = EmissionSampling::measure;
    return settings;
}

TEST_F(ProfiledLights, SampledByTheirMeasure_AgreeWithTheCpu) {
    render::RenderSettings settings = centred();
    settings.strategies = Strategies::diffuse_ltc;
    const scene::Scene scene = make_polygon_scene(kWidth, kHeight, 30);
    VulkanRenderer renderer = renderer_of(scene);
    expect_agreement(renderer, scene, make_polygon_scene(kWidth, kHeight, 50), settings);
    expect_agreement(renderer, scene, make_polygon_scene(kWidth, kHeight, 30, 60), settings);
}

TEST_F(ProfiledLights, AreNotIntegrated) {
    render::RenderSettings settings = centred();
    settings.technique = Technique::ltc_analytic;
    const scene::Scene scene = make_polygon_scene(8, 8, 30);
    EXPECT_EQ(render_vulkan::why_unsupported(scene, settings),
              "--technique ltc_analytic is not supported on GPUs for polygons with a profile, a spread or a "
              "honeycomb");
    EXPECT_EQ(render_vulkan::why_unsupported(scene, centred()), std::nullopt);
    EXPECT_EQ(render_vulkan::why_unsupported(make_plain_scene(8, 8), settings), std::nullopt);
    VulkanRenderer renderer = renderer_of(scene);
    EXPECT_THROW(renderer.render(settings), std::invalid_argument);
}

TEST_F(ProfiledLights, HaveAWarningWhereTheyAreSampledByTheirMeasureInPlaceOfProducts) {
    const render_vulkan::VulkanBackend backend({.validation = gpu::Validation::on},
                                               render_vulkan::ShadowRays::none);
    scene::Scene scene = make_polygon_scene(8, 8, 30);
    render::RenderSettings settings;
    EXPECT_EQ(backend.warnings(scene, settings).size(), 1u);
    settings.emission_sampling = EmissionSampling::measure;
    EXPECT_EQ(backend.warnings(scene, settings).size(), 0u);
    settings = {};
    settings.strategies = Strategies::diffuse_ltc;
    EXPECT_EQ(backend.warnings(scene, settings).size(), 1u);
    settings.mis = render::Mis::optimal; // the CPU does not either
    EXPECT_EQ(backend.warnings(scene, settings).size(), 0u);
    settings = {};
    for (scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>()) light.profile = -1;
    EXPECT_EQ(backend.warnings(scene, settings).size(), 0u);
}

} // namespace
} // namespace nusselt::render_vulkan_test
