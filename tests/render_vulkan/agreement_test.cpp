/// With pixel centres and the same random numbers, the GPU renders the image of the CPU.

#include "common/source_folder.h"
#include "comparison.h"
#include "gpu_test.h"
#include "render/film.h"
#include "rich_scene.h"
#include "scene/import/importers.h"
#include "scenes.h"

#include <filesystem>
#include <set>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using render::Strategies;
using render::Technique;
using render_vulkan::ShadowRays;
using render_vulkan::VulkanRenderer;
using scene::Float3;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

using lab::kLargestDifferingShare;

render::RenderSettings centred(int samples) {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = samples;
    return settings;
}

class Agreement : public parity::GpuTest {
protected:
    void expect_agreement(const scene::Scene& scene, VulkanRenderer& renderer,
                          const render::RenderSettings& settings) {
        const render::RenderResult result = renderer.render(settings);
        EXPECT_LT(differing_share(result.image, render_on_cpu(scene, settings)), kLargestDifferingShare);
        EXPECT_EQ(result.statistics.rejected_samples, 0u);
        EXPECT_EQ(result.finished_fraction, 1);
    }
};

TEST_F(Agreement, OfTextures_Instances_AndAllKindsOfLights) {
    const scene::Scene scene = make_opaque_scene(kWidth, kHeight);
    for (const ShadowRays way : {ShadowRays::query, ShadowRays::bvh}) {
        if (way == ShadowRays::query && !device().features().ray_queries) continue;
        SCOPED_TRACE(name_of(way));
        VulkanRenderer renderer(device(), scene, way);
        render::RenderSettings settings = centred(4);
        settings.strategies = Strategies::diffuse_ltc;
        expect_agreement(scene, renderer, settings);
    }
}

TEST_F(Agreement, OfLightsWithoutExtent) {
    const scene::Scene scene = make_scene_of_light_sources(kWidth, kHeight);
    VulkanRenderer renderer(device(), scene, render_vulkan::default_shadow_rays(device()));
    render::RenderSettings settings = centred(4);
    settings.strategies = Strategies::diffuse_ltc;
    expect_agreement(scene, renderer, settings);
    settings.strategies = Strategies::diffuse;
    settings.technique = Technique::ltc_analytic;
    expect_agreement(scene, renderer, settings);
}

/// The test of the test: the image would differ without one of the lights, or with another falloff.
TEST(LightsWithoutExtent, AllMatter) {
    const scene::Scene scene = make_scene_of_light_sources(kWidth, kHeight);
    const render::RenderSettings settings = centred(1);
    const image::Image image = render_on_cpu(scene, settings);
    const auto share_with = [&](const auto& change) {
        scene::Scene other = scene;
        change(other);
        return differing_share(render_on_cpu(other, settings), image);
    };
    const std::size_t points = scene.lights.of<scene::PointLight>().size();
    ASSERT_EQ(points, 7u);
    for (std::size_t i = 0; i < points; ++i)
        EXPECT_GT(share_with([&](scene::Scene& other) {
                      other.lights.of<scene::PointLight>()[i].intensity = {0, 0, 0};
                  }),
                  kLargestDifferingShare)
            << i;
    EXPECT_GT(share_with([](scene::Scene& other) { other.lights.of<scene::DistantLight>().clear(); }),
              kLargestDifferingShare);
    using scene::PointDistribution;
    // The other handedness of the horizontal angles of a luminaire.
    EXPECT_GT(share_with([](scene::Scene& other) {
                  Float3& axis = other.lights.of<scene::PointLight>().back().y_axis;
                  axis = {-axis.x, -axis.y, -axis.z};
              }),
              kLargestDifferingShare);
    EXPECT_GT(share_with([](scene::Scene& other) {
                  for (scene::PointLight& light : other.lights.of<scene::PointLight>())
                      if (light.distribution == PointDistribution::quartic_cone)
                          light.distribution = PointDistribution::smooth_cone;
              }),
              kLargestDifferingShare);
}

TEST_F(Agreement, OfPhongSurfaces) {
    scene::Scene scene = make_opaque_scene(kWidth, kHeight);
    float exponent = 30;
    for (scene::Material& material : scene.materials) {
        if (material.model != scene::BrdfModel::frostbite) continue;
        material.model = scene::BrdfModel::phong;
        material.exponent = exponent;
        exponent = 400;
    }
    ASSERT_EQ(exponent, 400);
    // Each kind of light makes drivers compile longer.
    scene.lights.of<scene::LineLight>().clear();
    VulkanRenderer renderer(device(), scene, render_vulkan::default_shadow_rays(device()));
    render::RenderSettings settings = centred(2);
    settings.strategies = Strategies::diffuse_ggx;
    settings.mis = render::Mis::balance;
    expect_agreement(scene, renderer, settings);
    // The fitted lobes.
    settings.strategies = Strategies::diffuse;
    settings.technique = Technique::ltc_analytic;
    expect_agreement(scene, renderer, settings);
}

/// The pipeline of the first test, where what is tested does not depend on settings.
render::RenderSettings settings_of_the_opaque_scene(int samples) {
    render::RenderSettings settings = centred(samples);
    settings.strategies = Strategies::diffuse_ltc;
    return settings;
}

/// Camera rays have the same bits.
TEST_F(Agreement, OfSurfacesThatArePartlyThere_SeenByTheCamera) {
    const scene::Scene scene = make_rich_scene(kWidth, kHeight);
    render::RenderSettings settings = centred(1);
    settings.technique = Technique::ltc_analytic;
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    expect_agreement(scene, renderer, settings);
}

TEST_F(Agreement, OfACrop) {
    scene::Scene scene = make_opaque_scene(kWidth, kHeight);
    scene.film.crop = scene::PixelBounds{13, 7, 50, 41};
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    const render::RenderSettings settings = settings_of_the_opaque_scene(2);
    const image::Image image = renderer.render(settings).image;
    EXPECT_EQ(image.width, 37);
    EXPECT_EQ(image.height, 34);
    expect_agreement(scene, renderer, settings);
}

TEST_F(Agreement, OfAnOrthographicCamera) {
    scene::Scene scene = make_opaque_scene(kWidth, kHeight);
    scene.camera = {.origin = {-2.4f, -4, 2.6f},
                    .origin_right = {4.8f / kWidth, 0, 0},
                    .origin_down = {0, 0, -3.2f / kHeight},
                    .corner = {0.05f, 1, -0.1f},
                    .right = {0, 0, 0},
                    .down = {0, 0, 0}};
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    expect_agreement(scene, renderer, settings_of_the_opaque_scene(2));
}

TEST_F(Agreement, OfEveryTechnique) {
    const scene::Scene scene = make_plain_scene(kWidth / 2, kHeight / 2);
    VulkanRenderer renderer(device(), scene, render_vulkan::default_shadow_rays(device()));
    for (const Technique technique : render::kTechniques) {
        SCOPED_TRACE(name_of(technique));
        render::RenderSettings settings = centred(2);
        settings.technique = technique;
        expect_agreement(scene, renderer, settings);
    }
}

TEST_F(Agreement, OfEveryHeuristic_Strategy_AndSampler) {
    scene::Scene scene = make_plain_scene(kWidth / 2, kHeight / 2);
    // All kinds of lights share what is tested, and drivers take the longer for each.
    scene.lights.of<scene::LineLight>().clear();
    VulkanRenderer renderer(device(), scene, render_vulkan::default_shadow_rays(device()));
    // Drivers take ten seconds for each order of samples, technique and pair of strategies, so that these share entries. The
    // heuristic costs nothing.
    std::vector<render::RenderSettings> all;
    std::set<render::SampleOrder> orders{render::RenderSettings().sample_order}; // OfEveryTechnique
    const auto add = [&](Technique technique, Strategies strategies, render::Mis mis,
                         render::SampleOrder order) {
        orders.insert(order);
        render::RenderSettings& settings = all.emplace_back(centred(6));
        settings.technique = technique;
        settings.strategies = strategies;
        settings.mis = mis;
        settings.sample_order = order;
        settings.visibility_estimate = 0.8f;
        settings.seed = 7;
    };
    using render::Mis;
    using render::SampleOrder;
    for (const Mis mis : render::kMisHeuristics)
        add(Technique::projected_solid_angle, Strategies::diffuse_ltc, mis, SampleOrder::blue_noise);
    add(Technique::projected_solid_angle_biased, Strategies::diffuse_ltc, Mis::balance,
        SampleOrder::stratified);
    add(Technique::projected_solid_angle, Strategies::diffuse_ggx, Mis::balance, SampleOrder::z_sobol);
    add(Technique::solid_angle, Strategies::diffuse_ggx_bounded, Mis::power, SampleOrder::jittered);
    add(Technique::projected_solid_angle, Strategies::diffuse, Mis::balance, SampleOrder::independent);
    all.back().brdf = render::BrdfChoice::lambert;
    EXPECT_EQ(orders.size(), render::kSampleOrders.size());
    for (const render::RenderSettings& settings : all) {
        SCOPED_TRACE(testing::Message()
                     << name_of(settings.technique) << ", " << name_of(settings.strategies) << ", "
                     << name_of(settings.mis) << ", " << name_of(settings.sample_order));
        expect_agreement(scene, renderer, settings);
    }
}

TEST_F(Agreement, OfShippedScenes) {
    // Other tests compare all techniques, and drivers take long for each.
    const std::vector<render::RenderSettings> settings{lab::compared_settings().back()};
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(nusselt_test::kSourceFolder) + "/scenes")) {
        if (entry.path().extension() != ".pbrt") continue;
        SCOPED_TRACE(entry.path().filename());
        scene::Scene scene = scene::load_scene(entry.path());
        render::resize_film(scene, kWidth, kHeight);
        for (const lab::ImageAgreement& row :
             lab::compare_with_cpu(device(), scene, std::array{ShadowRays::bvh}, settings)) {
            EXPECT_TRUE(row.passes()) << row.share << ", " << row.rejected_samples;
        }
    }
}

/// Drivers end what takes long: the renderer takes such frames in pieces.
TEST_F(Agreement, OfManySamplesAndLightsInAFrame) {
    scene::Scene scene = render_test::make_floor(8);
    for (int i = 0; i < 700; ++i) {
        const float x = 0.1f * static_cast<float>(i % 30) - 1.5f;
        const float y = 0.1f * static_cast<float>(i / 30) - 1.2f;
        render_test::add_polygon_light(
            scene, {scene::Float3{x, y, 2}, {x, y + 0.05f, 2}, {x + 0.05f, y + 0.05f, 2}, {x + 0.05f, y, 2}},
            {1, 1, 1}, false, 0);
    }
    render_test::add_line_light(scene, "line",
                                {0, {-1, 0, 1}, {1, 0, 1}, 0.01f, {1, 1, 1}, scene::TubeModel::linear});
    render_test::set_radius(scene);
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    expect_agreement(scene, renderer, centred(1));
    scene.lights.of<scene::PolygonLight>().resize(1);
    VulkanRenderer with_few(device(), scene, ShadowRays::bvh);
    render::RenderSettings many = centred(16384);
    expect_agreement(scene, with_few, many);
    many.technique = Technique::ltc_analytic;
    expect_agreement(scene, with_few, many);
}

/// The test of the test.
TEST_F(Agreement, RejectsOtherRandomNumbers_AndALightThatIsALittleBrighter) {
    scene::Scene scene = make_opaque_scene(kWidth, kHeight);
    render::RenderSettings settings = settings_of_the_opaque_scene(1);
    const image::Image reference = render_on_cpu(scene, settings);
    settings.seed = 1;
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    EXPECT_GT(differing_share(renderer.render(settings).image, reference), 2 * kLargestDifferingShare);
    settings.seed = 0;
    for (scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>()) light.radiance.y *= 1.01f;
    VulkanRenderer brighter(device(), scene, ShadowRays::bvh);
    EXPECT_GT(differing_share(brighter.render(settings).image, reference), 2 * kLargestDifferingShare);
}

} // namespace
} // namespace nusselt::render_vulkan_test
