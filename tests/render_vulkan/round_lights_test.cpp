/// Spheres, disks, ellipses and ellipsoids on GPUs and on the CPU.

#include "comparison.h"
#include "gpu_test.h"
#include "lights/round_scenes.h"
#include "rich_scene.h"
#include "scenes.h"

#include "scene/model/lights/round/round_form.h"

#include <cstdint>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using lab::kLargestDifferingShare;
using render::Strategies;
using render::Technique;
using render_test::add_round_light;
using render_vulkan::VulkanRenderer;
using scene::RoundLight;
using scene::RoundModel;
using scene::RoundShape;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/// The surfaces of make_plain_scene() without lights.
scene::Scene make_dark_scene() {
    scene::Scene scene = make_plain_scene(kWidth, kHeight);
    const std::uint32_t count = scene.objects.front().first_triangle;
    scene.objects.clear();
    scene.triangles.resize(count);
    scene.triangle_material.resize(count);
    scene.triangle_light.assign(count, -1);
    scene.lights.clear();
    scene.emitters.clear();
    return scene;
}

/// All shapes: a sphere that the floor cuts, a disk that faces the floor, an ellipse on both sides of which the wall and the floor
/// lie, an oblique ellipsoid, and a hollow one around all of them and the camera.
scene::Scene make_scene() {
    scene::Scene scene = make_dark_scene();
    add_round_light(scene, {.model = RoundModel::ellipsoid,
                            .center = {-1, -0.6f, 0.1f},
                            .u = {0.3f, 0, 0},
                            .v = {0, 0.3f, 0},
                            .w = {0, 0, 0.3f},
                            .radiance = {5, 3, 2}});
    add_round_light(scene, {.model = RoundModel::ellipse,
                            .center = {0.2f, 0, 2.6f},
                            .u = {0, 0.5f, 0},
                            .v = {0.5f, 0, 0},
                            .w = {0, 0, 0},
                            .radiance = {4, 4, 6}});
    add_round_light(scene, {.model = RoundModel::ellipse,
                            .center = {-1, 1.2f, 1.4f},
                            .u = {0.5f, 0.2f, 0.1f},
                            .v = {0, -0.1f, 0.3f},
                            .w = {0, 0, 0},
                            .radiance = {3, 6, 3},
                            .two_sided = true});
    add_round_light(scene, {.model = RoundModel::ellipsoid,
                            .center = {1, 0.6f, 0.9f},
                            .u = {0.5f, 0.1f, 0.2f},
                            .v = {0, 0.2f, 0.1f},
                            .w = {-0.1f, 0.1f, 0.3f},
                            .radiance = {6, 6, 2}});
    add_round_light(scene, {.model = RoundModel::hollow,
                            .center = {0, -1, 0.5f},
                            .u = {7, 0, 1},
                            .v = {0, 8, 0},
                            .w = {-1, 0, 5},
                            .radiance = {0.1f, 0.12f, 0.15f}});
    render_test::set_camera(scene, {0.3f, -4.5f, 1.7f}, {0, 0, 1.2f}, {0, 0, 1}, 0.45, kWidth, kHeight);
    render_test::set_radius(scene);
    return scene;
}

render::RenderSettings settings_of(Technique technique, Strategies strategies) {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = 4;
    settings.technique = technique;
    settings.strategies = strategies;
    return settings;
}

using RoundLightsOnGpu = parity::GpuTest;

TEST_F(RoundLightsOnGpu, AgreeWithTheCpu) {
    const scene::Scene scene = make_scene();
    std::vector<RoundShape> shapes;
    for (const scene::RoundForm& form : round_forms(scene)) shapes.push_back(form.shape);
    ASSERT_EQ(shapes, (std::vector{RoundShape::sphere, RoundShape::disk, RoundShape::ellipse,
                                   RoundShape::ellipsoid, RoundShape::ellipsoid}));
    VulkanRenderer renderer(device(), scene, render_vulkan::default_shadow_rays(device()));
    for (const auto& settings : {settings_of(Technique::projected_solid_angle, Strategies::diffuse_ltc),
                                 settings_of(Technique::area, Strategies::diffuse),
                                 settings_of(Technique::clipped_solid_angle, Strategies::diffuse),
                                 settings_of(Technique::ltc_analytic, Strategies::diffuse)}) {
        SCOPED_TRACE(name_of(settings.technique));
        const render::RenderResult result = renderer.render(settings);
        const image::Image reference = render_on_cpu(scene, settings);
        // At outlines, too: cameras and shadow rays of both meet the exact shapes.
        EXPECT_LT(differing_share(result.image, reference), kLargestDifferingShare);
        EXPECT_EQ(result.statistics.rejected_samples, 0u);
    }
}

/// A round light that fills the image, of a material with all that follows texture coordinates, in the light of another
/// one.
scene::Scene make_textured_scene(const RoundLight& shape) {
    scene::Scene scene = make_dark_scene();
    scene.triangles.clear();
    scene.triangle_material.clear();
    scene.triangle_light.clear();
    scene::Texture texture{.name = "noise", .width = 16, .height = 12};
    std::uint32_t state = 1;
    for (int i = 0; i < 3 * texture.width * texture.height; ++i) {
        state = state * 747796405u + 2891336453u;
        texture.texels.push_back(static_cast<float>(state >> 8) * 0x1p-24f);
    }
    const int number = static_cast<int>(scene.textures.size());
    scene.textures.push_back(texture);
    scene.materials.resize(1);
    scene.materials[0] = {.name = "all",
                          .diffuse = {0.9f, 0.9f, 0.9f},
                          .diffuse_texture = {number},
                          .alpha_texture = {number, {1, 3}, {0, 0.3f}},
                          .bump = 0.02f,
                          .bump_texture = {number, {2, 1}, {0.1f, 0}},
                          .bump_unit = scene::BumpUnit::texture_coordinate};
    add_round_light(scene, shape);
    add_round_light(scene, {.model = RoundModel::ellipse,
                            .center = {0, 0, 9},
                            .u = {0, 4, 0},
                            .v = {4, 0, 0},
                            .w = {0, 0, 0},
                            .radiance = {2, 2, 2}});
    render_test::set_camera(scene, {0.3f, -2, 4}, {0, 0, 0}, {0, 0, 1}, 0.25, kWidth, kHeight);
    render_test::set_radius(scene);
    return scene;
}

TEST_F(RoundLightsOnGpu, HaveTexturesBumpsAndAlphaOfTheCpu) {
    const auto settings = settings_of(Technique::ltc_analytic, Strategies::diffuse);
    for (const RoundLight& light :
         {RoundLight{
              .u = {1, 0, 0.2f}, .v = {0, 1, 0}, .w = {-0.3f, 0.1f, 0.8f}, .radiance = {0.1f, 0.1f, 0.1f}},
          RoundLight{.model = RoundModel::ellipse,
          .u = {0.9f, 0, 0.2f},
          .v = {0.1f, 1, 0},
          .w = {0, 0, 0},
          .radiance = {0.1f, 0.1f, 0.1f}}}) {
        scene::Scene scene = make_textured_scene(light);
        const image::Image reference = render_on_cpu(scene, settings);
        const auto on_gpu = [&] {
            VulkanRenderer renderer(device(), scene, render_vulkan::ShadowRays::none);
            return renderer.render(settings).image;
        };
        EXPECT_LT(differing_share(on_gpu(), reference), kLargestDifferingShare);
        // The test of the test: each of them shows.
        for (scene::TextureUse scene::Material::*use :
             {&scene::Material::diffuse_texture, &scene::Material::bump_texture,
              &scene::Material::alpha_texture}) {
            scene.materials[0].*use = {};
            EXPECT_GT(differing_share(render_on_cpu(scene, settings), reference), 3 * kLargestDifferingShare);
            scene = make_textured_scene(light);
        }
    }
}

/// The test of the test: the image would differ without one of the lights, if a light were a little larger, or if a light shone to
/// its other side.
TEST(RoundLights, AllMatter) {
    const scene::Scene scene = make_scene();
    const render::RenderSettings settings = settings_of(Technique::ltc_analytic, Strategies::diffuse);
    const image::Image image = render_on_cpu(scene, settings);
    const auto share_with = [&](std::size_t i, const auto& change) {
        scene::Scene other = scene;
        change(other.lights.of<RoundLight>()[i]);
        return differing_share(render_on_cpu(other, settings), image);
    };
    for (std::size_t i = 0; i < scene.lights.of<RoundLight>().size(); ++i) {
        SCOPED_TRACE(i);
        EXPECT_GT(share_with(i,
                             [](RoundLight& light) {
                                 light.radiance = {0, 0, 0};
                             }),
                  2 * kLargestDifferingShare);
        if (i == 4) continue; // from inside, its size does not matter
        EXPECT_GT(share_with(i,
                             [](RoundLight& light) {
                                 light.u.x *= 1.05f;
                                 light.u.y *= 1.05f;
                                 light.u.z *= 1.05f;
                             }),
                  2 * kLargestDifferingShare);
    }
    EXPECT_GT(share_with(2, [](RoundLight& light) { light.two_sided = false; }), 2 * kLargestDifferingShare);
    EXPECT_GT(share_with(4, [](RoundLight& light) { light.model = RoundModel::ellipsoid; }),
              2 * kLargestDifferingShare);
}

} // namespace
} // namespace nusselt::render_vulkan_test
