/// Lights whose radiance depends on the direction: the GPU renders the image of the CPU.

#include "emission_test.h"
#include "render_vulkan/backend.h"
#include "rich_scene.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/profiles/line_profile.h"
#include "scenes.h"

#include <algorithm>
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

/// Gives a light a profile and adds it. \param light with a normal
void add_line(scene::Scene& scene, scene::LineLight light, const scene::ProfileRequest& request) {
    light.profile = static_cast<std::int32_t>(scene.emission_profiles.size());
    scene.emission_profiles.push_back(scene::profile_line(light, request).emissions.at(0));
    render_test::add_line_light(scene, "light", light);
}

scene::Scene make_room() {
    scene::Scene scene = make_plain_scene(kWidth, kHeight);
    scene.lights.clear();
    scene.emitters.clear();
    std::fill(scene.triangle_light.begin(), scene.triangle_light.end(), -1);
    return scene;
}

/// Linear lights, one that shines as a luminaire and one with a spread, and strips with both, which the camera sees.
scene::Scene make_lines(double angle, double spread) {
    scene::Scene scene = make_room();
    scene::LineLight line{.start = {-1.5f, -1, 0.6f},
                          .end = {-1.4f, 1, 1.8f},
                          .radius = 0.02f,
                          .radiance = {20, 15, 10},
                          .model = scene::TubeModel::linear};
    line.normal = scene::perpendicular_to_line(line, {0.8, 0, -0.6});
    add_line(scene, line, {make_luminaire(), scene::kWidestSpread, angle});
    scene::LineLight beam = line;
    beam.start.x += 2.5f;
    beam.normal = scene::perpendicular_to_line(beam, {0, 0, 1});
    add_line(scene, beam, {nullptr, spread, 0});
    scene::LineLight strip{.start = {-0.9f, 1.5f, 1},
                           .end = {0.9f, 1.4f, 1.2f},
                           .radius = 0.05f,
                           .radiance = {20, 10, 30},
                           .model = scene::TubeModel::strip};
    strip.normal = scene::perpendicular_to_line(strip, {0, -0.8, 0.6});
    add_line(scene, strip, {make_luminaire(), 150, 20});
    return scene;
}

/// Tubes that the camera sees, with bright and with dark caps.
scene::Scene make_tubes(double angle, double spread) {
    scene::Scene scene = make_room();
    scene::LineLight tube{.start = {-1, 1, 2}, .end = {1, 1.2f, 2.2f}, .radius = 0.1f, .radiance = {5, 5, 6}};
    tube.normal = scene::perpendicular_to_line(tube, {0, -1, -1});
    add_line(scene, tube, {make_luminaire(), scene::kWidestSpread, angle});
    scene::LineLight open{.start = {0.2f, -0.6f, 0.4f},
                          .end = {0.3f, -0.5f, 1.7f},
                          .radius = 0.12f,
                          .radiance = {4, 6, 4},
                          .model = scene::TubeModel::open};
    open.normal = scene::perpendicular_to_line(open, {-1, 0, 0});
    add_line(scene, open, {nullptr, spread, 0});
    return scene;
}

class ProfiledLights : public EmissionTest {
protected:
    /// A profile that is turned and a spread that is wider are the tests of the test.
    void expect_agreement_of(scene::Scene (&make)(double angle, double spread),
                             const render::RenderSettings& settings) const {
        const scene::Scene scene = make(30, 120);
        VulkanRenderer renderer = renderer_of(scene);
        expect_agreement(renderer, scene, make(50, 120), settings);
        expect_agreement(renderer, scene, make(30, 140), settings);
    }
};

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

TEST_F(ProfiledLights, WithoutExtent_AgreeWithTheCpu) {
    render::RenderSettings settings = centred();
    settings.strategies = Strategies::diffuse_ltc;
    expect_agreement_of(make_lines, settings);
}

TEST_F(ProfiledLights, OfTubes_AgreeWithTheCpu) {
    render::RenderSettings settings = centred();
    settings.technique = Technique::solid_angle;
    expect_agreement_of(make_tubes, settings);
}

TEST_F(ProfiledLights, AreNotIntegrated) {
    render::RenderSettings settings = centred();
    settings.technique = Technique::ltc_analytic;
    for (const scene::Scene& scene :
         {make_polygon_scene(8, 8, 30), make_lines(30, 100), make_tubes(30, 100)}) {
        EXPECT_EQ(
            render_vulkan::why_unsupported(scene, settings),
            "--technique ltc_analytic is not supported on GPUs for lights with a profile, a spread or a "
            "honeycomb");
        EXPECT_EQ(render_vulkan::why_unsupported(scene, centred()), std::nullopt);
        VulkanRenderer renderer = renderer_of(scene);
        EXPECT_THROW(renderer.render(settings), std::invalid_argument);
    }
    EXPECT_EQ(render_vulkan::why_unsupported(make_plain_scene(8, 8), settings), std::nullopt);
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
    EXPECT_EQ(backend.warnings(make_lines(30, 100), settings).size(), 1u);
    settings.strategies = Strategies::diffuse_ggx;
    EXPECT_EQ(backend.warnings(make_lines(30, 100), settings).size(), 1u);
    settings = {};
    EXPECT_EQ(backend.warnings(make_tubes(30, 100), settings).size(), 0u)
        << "the CPU samples them by their measure";
    for (scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>()) light.profile = -1;
    EXPECT_EQ(backend.warnings(scene, settings).size(), 0u);
}

} // namespace
} // namespace nusselt::render_vulkan_test
