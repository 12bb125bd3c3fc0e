// Kinds of light are rows of tables. Discs are one that only tests have: a folder and a row. All that the product does with
// lights of any kind must reach them.

#include "scenes.h"
#include "toy_light/disc_kernel.h"
#include "toy_light/faulty_disc.h"
#include "toy_light/row_contract.h"

#include "scene/model/bounds.h"
#include "scene/model/fingerprint.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_report.h"
#include "scene/model/scene_size.h"
#include "scene/rig/light_edit.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::render_test {
namespace {

using render::LayerKind;
using scene::DiscLight;
using scene::Double3;

constexpr float kHeight = 1.5f;
constexpr float kRadius = 0.5f;
constexpr float kRadiance = 3;
constexpr int kSize = 16;

/// It shines down.
DiscLight make_disc() {
    return {.center = {0, 0, kHeight},
            .normal = {0, 0, -1},
            .radius = kRadius,
            .radiance = {kRadiance, kRadiance, kRadiance}};
}

void add_disc(scene::Scene& scene, DiscLight light) {
    light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({"disc"});
    scene.lights.of<DiscLight>().push_back(light);
}

/// A floor, seen from above by parallel rays, below a disc. The camera is below the disc, too.
scene::Scene make_disc_scene() {
    scene::Scene scene = make_floor(kSize);
    scene.camera = {.origin = {-1, -1, 1},
                    .origin_right = {2.0f / kSize, 0, 0},
                    .origin_down = {0, 2.0f / kSize, 0},
                    .corner = {0, 0, -1},
                    .right = {0, 0, 0},
                    .down = {0, 0, 0}};
    add_disc(scene, make_disc());
    scene.radius = scene_radius(scene);
    return scene;
}

/// The camera looks up at the disc, which fills the image.
scene::Scene make_scene_that_sees_disc() {
    scene::Scene scene = make_disc_scene();
    scene.camera.origin = {-0.1f, -0.1f, 0.5f};
    scene.camera.origin_right.x = scene.camera.origin_down.y = 0.2f / kSize;
    scene.camera.corner = {0, 0, 1};
    return scene;
}

/// Radiance of the floor: the form factor of a disc in a parallel plane.
double floor_radiance(double distance_from_axis) {
    const double h = kHeight / distance_from_axis;
    const double r = kRadius / distance_from_axis;
    const double z = 1 + h * h + r * r;
    return static_cast<double>(kFloorAlbedo) * kRadiance * 0.5 *
           (1 - (z - 2 * r * r) / std::sqrt(z * z - 4 * r * r));
}

image::Image expected_image() {
    image::Image image = image::make_image(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const auto at = [](int pixel) { return -1 + 2 * (pixel + 0.5) / kSize; };
            for (int k = 0; k < 3; ++k)
                image.pixels[static_cast<std::size_t>(3 * (y * kSize + x) + k)] =
                    static_cast<float>(floor_radiance(std::hypot(at(x), at(y))));
        }
    return image;
}

class LightKinds : public testing::Test {
protected:
    const std::vector<render_cpu::LightKernel> kernels_ = render_cpu::kernels_with_discs();
    const render_cpu::Integrator& integrator_ = render_cpu::integrators().front();

    render_cpu::Renderer renderer(const scene::Scene& scene) const {
        return {scene, 2, integrator_, kernels_};
    }
};

TEST_F(LightKinds, ReflectTheirLightAsClosedFormsSay) {
    const scene::Scene scene = make_disc_scene();
    const render_cpu::Renderer disc = renderer(scene);
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.sample_order = render::SampleOrder::independent;
    settings.samples = 16;
    settings.technique = render::Technique::area;
    settings.strategies = render::Strategies::diffuse;
    const auto rows = render_region_means(disc, settings, kSeeds, disc.visibility().tracer());
    EXPECT_LT(largest_t(rows, region_means(expected_image(), kRegionsPerAxis)), kLargestT);
}

TEST_F(LightKinds, AreTakenByAllSettings) {
    const scene::Scene scene = make_disc_scene();
    const render_cpu::Renderer disc = renderer(scene);
    const double expected = region_means(expected_image(), 1)[0];
    for (const base::Isa isa : base::kAllIsas) {
        if (!is_supported(isa)) continue;
        for (int technique = 0; technique < interface::kTechniqueCount; ++technique) {
            for (int strategies = 0; strategies < interface::kStrategiesCount; ++strategies) {
                for (const auto samples : {render::LightSamples::points, render::LightSamples::lines}) {
                    render::RenderSettings settings;
                    settings.technique = static_cast<render::Technique>(technique);
                    settings.strategies = static_cast<render::Strategies>(strategies);
                    settings.light_samples = samples;
                    settings.samples = 64;
                    settings.pixel_position = render::PixelPosition::center;
                    try {
                        validate(settings);
                    } catch (const std::invalid_argument&) {
                        continue;
                    }
                    EXPECT_NEAR(region_means(disc.render(settings, isa).image, 1)[0], expected,
                                0.01 * expected)
                        << technique << " " << strategies;
                }
            }
        }
    }
}

TEST_F(LightKinds, AreSeenByCameras) {
    const scene::Scene scene = make_scene_that_sees_disc();
    render::RenderSettings settings;
    settings.layers = {LayerKind::depth, LayerKind::emission, LayerKind::lights};
    const render::RenderResult result = renderer(scene).render(settings, base::choose_isa());
    EXPECT_EQ(region_means(result.image, 1)[0], kRadiance);
    const auto first_value = [&](const std::string& name) {
        for (const image::Layer& layer : result.layers)
            if (layer.name == name) return layer.data.at(0);
        throw std::runtime_error("no layer " + name);
    };
    EXPECT_EQ(first_value("depth"), kHeight - 0.5f);
    EXPECT_EQ(first_value("emission"), kRadiance);
    EXPECT_EQ(first_value("light.disc"), kRadiance);
}

TEST_F(LightKinds, EmitWhatTheirRowSays) {
    // A row whose emission is wrong: no other code may answer for it.
    std::vector<render_cpu::LightKernel> wrong = kernels_;
    for (render_cpu::LightCode& code : wrong.back().code)
        code.emission = [](const render_cpu::LightSet&, std::int32_t, const scene::Float3&,
                           const scene::Float3&) noexcept {
            return scene::Float3{7, 7, 7};
        };
    const scene::Scene scene = make_scene_that_sees_disc();
    const render_cpu::Renderer disc(scene, 2, integrator_, wrong);
    EXPECT_EQ(region_means(disc.render({}, base::choose_isa()).image, 1)[0], 7);
}

TEST_F(LightKinds, TakeLinesIfTheirRowSaysSo) {
    render::RenderSettings settings;
    settings.light_samples = render::LightSamples::lines;
    const scene::Scene scene = make_disc_scene();
    const auto build_seconds = [&](const std::vector<render_cpu::LightKernel>& kernels) {
        const render_cpu::Renderer disc(scene, 2, integrator_, kernels);
        return disc.render(settings, base::choose_isa()).statistics.lines.build_seconds;
    };
    EXPECT_EQ(build_seconds(kernels_), 0);
    std::vector<render_cpu::LightKernel> with_lines = kernels_;
    with_lines.back().takes_lines = true;
    EXPECT_GT(build_seconds(with_lines), 0);
}

TEST_F(LightKinds, WithoutARowAreErrors) {
    const scene::Scene scene = make_disc_scene();
    try {
        const render_cpu::Renderer other(scene, 1);
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "the CPU renderer does not support disc lights");
    }
}

TEST_F(LightKinds, ArePartOfTheScene) {
    scene::Scene scene = make_disc_scene();
    const scene::Scene without = make_floor(kSize);
    EXPECT_EQ(scene_bounds(scene).high.z, kHeight + kRadius);
    EXPECT_EQ(array_bytes(scene), array_bytes(without) + sizeof(DiscLight) + sizeof(scene::Emitter));
    const std::string before = fingerprint(scene);
    scene.lights.of<DiscLight>()[0].radius *= 2;
    EXPECT_NE(fingerprint(scene), before);
    std::ostringstream report;
    write_light_report(make_disc_scene(), report);
    EXPECT_EQ(report.str(), "1 disc light\n"
                            "  disc: radius 0.5 m, power 7.4022 7.4022 7.4022 W\n");
}

TEST_F(LightKinds, AreWrittenAsRigs) {
    EXPECT_EQ(to_rig_text(make_disc_scene()), R"({"version": 1,
  "lights": [
    {"light": 0,
     "name": "disc",
     "center": [0, 0, 1.5],
     "radiance": [3, 3, 3]}]}
)");
}

template <scene::Fault fault>
std::vector<std::string> defects_with() {
    return row_defects(scene::FaultyDisc<fault>{make_disc()});
}

TEST(LightRows, FulfilTheContract) {
    const std::vector<std::string> none;
    EXPECT_EQ(row_defects(make_disc()), none);
    const std::initializer_list<scene::Float3> corners = {{1, 1, 1}, {2, 1, 1}, {2, 2, 1.5f}, {1, 2, 1.5f}};
    for (const bool two_sided : {false, true})
        EXPECT_EQ(row_defects(scene::PolygonLight{
                      .vertices = corners, .radiance = {1, 2, 3}, .two_sided = two_sided}),
                  none);
    for (const auto model :
         {scene::RoundModel::ellipse, scene::RoundModel::ellipsoid, scene::RoundModel::hollow}) {
        const scene::Float3 w =
            model == scene::RoundModel::ellipse ? scene::Float3{0, 0, 0} : scene::Float3{0.2f, 0, 0.6f};
        EXPECT_EQ(row_defects(scene::RoundLight{.model = model,
                                                .center = {1, 2, 3},
                                                .u = {0.5f, 0.1f, 0},
                                                .v = {0, 0.7f, 0.1f},
                                                .w = w,
                                                .radiance = {1, 2, 3}}),
                  none);
    }
    for (const auto model :
         {scene::TubeModel::linear, scene::TubeModel::solid, scene::TubeModel::open, scene::TubeModel::strip})
        EXPECT_EQ(row_defects(scene::LineLight{.start = {1, 2, 3},
                                               .end = {2, 2, 3},
                                               .radius = 0.1f,
                                               .radiance = {1, 2, 3},
                                               .model = model,
                                               .normal = {0, 0.6f, 0.8f}}),
                  none);
}

TEST(LightRows, OfLightsWithoutExtentFulfilTheContract) {
    const std::vector<std::string> none;
    const Extent point{.has_bounds = false, .flux_of_twice = 1};
    for (int i = 0; i <= static_cast<int>(scene::PointDistribution::projected_image); ++i)
        EXPECT_EQ(row_defects(scene::PointLight{.position = {1, 2, 3},
                                                .intensity = {1, 2, 3},
                                                .distribution = static_cast<scene::PointDistribution>(i),
                                                .image_integral = {1, 2, 3}},
                              point),
                  none);
    EXPECT_EQ(row_defects(scene::DistantLight{.direction = {0, 0.6f, 0.8f}, .irradiance = {1, 2, 3}},
                          {.has_bounds = false, .has_place = false, .flux_of_twice = 1}),
              none);
}

TEST(LightRows, WithAFaultAreNoticed) {
    using scene::Fault;
    const std::pair<std::vector<std::string>, const char*> faults[] = {
        {defects_with<Fault::bounds>(), "add_to"},          {defects_with<Fault::hash>(), "hash"},
        {defects_with<Fault::flux>(), "flux_per_emission"}, {defects_with<Fault::moment>(), "add_moment"},
        {defects_with<Fault::validity>(), "is_valid"},      {defects_with<Fault::transform>(), "transform"},
        {defects_with<Fault::same_shape>(), "same_shape"},  {defects_with<Fault::sides>(), "two_sided"},
        {defects_with<Fault::mesh>(), "add_mesh"},          {defects_with<Fault::hit>(), "hit"},
        {defects_with<Fault::description>(), "describe"},   {defects_with<Fault::rig_field>(), "rig_field"}};
    for (const auto& [defects, member] : faults)
        EXPECT_EQ(std::count(defects.begin(), defects.end(), member), 1) << member;
}

TEST_F(LightKinds, AreHitByRays) {
    const scene::Scene scene = make_disc_scene();
    const scene::LightMesh mesh = make_light_mesh(scene);
    ASSERT_FALSE(mesh.triangles.empty());
    EXPECT_EQ(mesh.lights, std::vector<std::uint32_t>(mesh.triangles.size(), 0));
    for (const scene::LightList& list : scene.lights) {
        if (list.size() == 0) continue;
        EXPECT_EQ(list.hit(0, {{0.1, 0, 0}, {0, 0, 1}, {}, {}}), kHeight);
        EXPECT_TRUE(std::isinf(list.hit(0, {{0.6, 0, 0}, {0, 0, 1}, {}, {}})));
    }
}

TEST_F(LightKinds, AreChangedByRigs) {
    scene::Scene scene = make_disc_scene();
    const double power = luminous_power(editable_lights(scene)[0], scene.radius);
    const auto change = [&](const auto& set) {
        scene::LightChanges changes;
        set(changes);
        apply_rig({.lights = {{"rig", scene::Selector("disc"), changes}}, .materials = {}}, scene);
    };
    change([&](scene::LightChanges& changes) {
        changes.scale = Double3{2, 2, 2};
        changes.move = Double3{1, 2, 3};
        changes.power = 2 * power;
    });
    ASSERT_EQ(scene.lights.of<DiscLight>().size(), 1u);
    const DiscLight& light = scene.lights.of<DiscLight>()[0];
    EXPECT_EQ(light.center, (Float3{1, 2, 3 + kHeight}));
    EXPECT_NEAR(light.radius, 2 * kRadius, 1e-6);
    EXPECT_NEAR(light.radiance.x, kRadiance / 2, 1e-6);
    EXPECT_THROW(change([](scene::LightChanges& changes) {
                     changes.scale = Double3{1, 2, 2};
                 }),
                 std::runtime_error);
    scene = make_disc_scene();
    EXPECT_THROW(change([](scene::LightChanges& changes) { changes.two_sided = true; }), std::runtime_error);
    scene = make_disc_scene();
    change([](scene::LightChanges& changes) { changes.shape = scene::only(DiscLight{.radius = 1}); });
    EXPECT_EQ(scene.lights.of<DiscLight>().at(0).radius, 1);
    EXPECT_EQ(scene.lights.of<DiscLight>()[0].radiance.x, kRadiance);
    change([](scene::LightChanges& changes) { changes.enabled = false; });
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(scene.emitters.empty());
}

} // namespace
} // namespace nusselt::render_test
