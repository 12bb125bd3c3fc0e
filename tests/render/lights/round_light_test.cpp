/// Spheres, disks, ellipsoids and ellipses give the light of tessellations into 4096 triangles, by all techniques and from all
/// sides.

#include "lights/round_scenes.h"
#include "lossy_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

namespace nusselt::render_test {
namespace {

using render::Strategies;
using render::Technique;
using scene::RoundLight;
using scene::RoundModel;

constexpr int kSize = 12;

struct Case {
    std::string name;
    RoundLight light;
    double loss =
        0.05; ///< of shadow rays, for the test of the test; 0 for lights that light nothing that is seen
};

RoundLight ellipse(const Float3& center, const Float3& u, const Float3& v) {
    return {.model = RoundModel::ellipse,
            .center = center,
            .u = u,
            .v = v,
            .w = {0, 0, 0},
            .radiance = {3, 2, 1}};
}

RoundLight two_sided(RoundLight light) {
    light.two_sided = true;
    return light;
}

std::vector<Case> cases() {
    RoundLight sheared = sphere({-0.2f, 0.1f, 0.9f}, 0.3f);
    sheared.u = {0.3f, 0.2f, 0.1f};
    sheared.w = {0.2f, 0, 0.4f};
    RoundLight cut = sheared;
    cut.center.z = 0.1f;
    return {{"sphere", sphere({0.1f, 0.2f, 0.9f}, 0.3f)},
            {"sphere in the floor", sphere({0.1f, 0.2f, 0.1f}, 0.3f)},
            {"ellipsoid", sheared},
            {"ellipsoid in the floor", cut},
            {"disk above", ellipse({0, 0, 0.8f}, {0.4f, 0, 0}, {0, -0.4f, 0})},
            {"upright disk", ellipse({0, 0, 0.2f}, {0, 0.3f, 0}, {0, 0, 0.3f})},
            {"sheared ellipse", ellipse({0.1f, 0, 0.5f}, {0.3f, 0.1f, 0.2f}, {0, -0.5f, 0.1f})},
            {"two-sided ellipse", two_sided(ellipse({0.1f, 0, 0.3f}, {0.3f, 0.1f, 0.2f}, {0, -0.5f, 0.1f}))},
            {"around everything", sphere({0.5f, 0, 0.3f}, 4, RoundModel::hollow)},
            {"around everything, two sides", two_sided(sphere({0.5f, 0, 0.3f}, 4))},
            {"around a part", sphere({0.3f, 0, 0.1f}, 0.7f, RoundModel::hollow), 0}};
}

/// A glossy floor with an occluder.
scene::Scene make_room() {
    scene::Scene scene = make_floor(kSize);
    scene.materials[0].model = scene::BrdfModel::frostbite;
    scene.materials[0].roughness = 0.5f;
    add_quad(
        scene,
        {Float3{0.3f, -0.5f, 0}, Float3{0.3f, 0.4f, 0}, Float3{0.3f, 0.4f, 0.3f}, Float3{0.3f, -0.5f, 0.3f}},
        0);
    return scene;
}

scene::Scene with(void (*add)(scene::Scene&, RoundLight), const RoundLight& light) {
    scene::Scene scene = make_room();
    add(scene, light);
    set_radius(scene);
    return scene;
}

void add_tessellated(scene::Scene& scene, RoundLight light) { add_tessellated_light(scene, light); }

using Rows = std::vector<std::vector<double>>;

Rows render(const scene::Scene& scene, const render::RenderSettings& settings, int seeds, double loss = 0) {
    const render_cpu::Renderer renderer(scene, 1);
    const LossyTracer lossy(renderer.visibility().tracer(), loss);
    return render_region_means(renderer, settings, seeds,
                               loss > 0 ? lossy.tracer() : renderer.visibility().tracer());
}

/// The largest difference of means in standard errors. Differences that 4096 flat pieces explain count as none.
double largest_difference(const Rows& a, const Rows& b) {
    constexpr double kFlatness = 2e-3;
    const auto column = [](const Rows& rows, std::size_t region) {
        std::vector<double> values;
        for (const auto& row : rows) values.push_back(row[region]);
        return values;
    };
    const auto mean_of = [](const std::vector<double>& x) {
        double sum = 0;
        for (const double value : x) sum += value;
        return sum / static_cast<double>(x.size());
    };
    const auto error_of = [&](const std::vector<double>& x) {
        double sum = 0;
        for (const double value : x) sum += (value - mean_of(x)) * (value - mean_of(x));
        const auto n = static_cast<double>(x.size());
        return std::sqrt(sum / (n * (n - 1)));
    };
    double largest = 0;
    for (std::size_t region = 0; region < a.front().size(); ++region) {
        const auto x = column(a, region), y = column(b, region);
        const double excess = std::fabs(mean_of(x) - mean_of(y)) - kFlatness * mean_of(y);
        const double error = std::hypot(error_of(x), error_of(y)) + 1e-9;
        largest = std::max(largest, excess / error);
    }
    return largest;
}

render::RenderSettings settings_for(Technique technique, Strategies strategies) {
    render::RenderSettings settings;
    settings.technique = technique;
    settings.strategies = strategies;
    settings.sample_order = render::SampleOrder::independent;
    settings.samples = 4;
    settings.pixel_position = render::PixelPosition::center;
    return settings;
}

class RoundLights : public testing::TestWithParam<Case> {};

TEST_P(RoundLights, GiveTheLightOfTessellations) {
    render::RenderSettings settings = settings_for(Technique::projected_solid_angle, Strategies::diffuse_ltc);
    settings.samples = 1;
    constexpr int kReferenceSeeds = 8;
    const Rows expected = render(with(add_tessellated, GetParam().light), settings, kReferenceSeeds);
    const scene::Scene scene = with(add_round_light, GetParam().light);
    for (const auto& [technique, strategies] :
         {std::pair{Technique::area, Strategies::diffuse},
          {Technique::solid_angle, Strategies::diffuse},
          {Technique::clipped_solid_angle, Strategies::diffuse},
          {Technique::projected_solid_angle, Strategies::diffuse},
          {Technique::projected_solid_angle, Strategies::diffuse_ltc}}) {
        const render::RenderSettings tested = settings_for(technique, strategies);
        EXPECT_LT(largest_difference(render(scene, tested, kSeeds), expected), kLargestT)
            << name_of(technique) << ' ' << name_of(strategies);
    }
    if (GetParam().loss == 0) return;
    const render::RenderSettings tested =
        settings_for(Technique::projected_solid_angle, Strategies::diffuse_ltc);
    EXPECT_GT(largest_difference(render(scene, tested, kSeeds, GetParam().loss), expected), kLargestT);
}

std::string test_name(const testing::TestParamInfo<Case>& instance) {
    std::string name = instance.param.name;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Shapes, RoundLights, testing::ValuesIn(cases()), test_name);

/// The red channel of a pixel that looks along a ray.
float seen(const RoundLight& light, const Float3& eye, const Float3& target) {
    scene::Scene scene;
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_round_light(scene, light);
    set_camera(scene, eye, target, {0, 1, 0}, 1e-3, 1, 1);
    set_radius(scene);
    return render_cpu::Renderer(scene, 1).render({}, base::choose_isa()).image.pixels[0];
}

TEST(RoundLight, IsSeenOnTheSidesThatEmit) {
    const RoundLight disk = ellipse({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(seen(disk, {0.1f, 0.1f, 3}, {0.1f, 0.1f, 0}), 3);
    EXPECT_EQ(seen(disk, {0.1f, 0.1f, -3}, {0.1f, 0.1f, 0}), 0);
    EXPECT_EQ(seen(two_sided(disk), {0.1f, 0.1f, -3}, {0.1f, 0.1f, 0}), 3);
    EXPECT_EQ(seen(disk, {0.72f, 0.72f, 3}, {0.72f, 0.72f, 0}), 0);
    const RoundLight outwards = sphere({0, 0, 0}, 1);
    const RoundLight inwards = sphere({0, 0, 0}, 1, RoundModel::hollow);
    EXPECT_EQ(seen(outwards, {0, 0, 3}, {0.2f, 0.1f, 0}), 3);
    EXPECT_EQ(seen(outwards, {0, 0, 0.5f}, {0.2f, 0.1f, 1}), 0);
    EXPECT_EQ(seen(inwards, {0, 0, 3}, {0.2f, 0.1f, 0}), 0);
    EXPECT_EQ(seen(inwards, {0, 0, 0.5f}, {0.2f, 0.1f, 1}), 3);
    EXPECT_EQ(seen(two_sided(outwards), {0, 0, 0.5f}, {0.2f, 0.1f, 1}), 3);
}

/// Disks above a parallel floor, and spheres: no shadows, no noise, and closed forms.
TEST(RoundLight, HasTheLightOfClosedForms) {
    const auto radiance = [](const RoundLight& light, Technique technique) {
        scene::Scene scene = make_floor(1);
        add_round_light(scene, light);
        set_camera(scene, {0.6f, 0, 0.5f}, {0.6f, 0, 0}, {0, 1, 0}, 1e-4, 1, 1);
        set_radius(scene);
        render::RenderSettings settings;
        settings.technique = technique;
        return double{render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image.pixels[0]};
    };
    for (const Technique technique : {Technique::projected_solid_angle, Technique::ltc_analytic}) {
        const double h = 1.5 / 0.6, r = 0.5 / 0.6;
        const double z = 1 + h * h + r * r;
        const double of_disk = 0.5 * (1 - (z - 2 * r * r) / std::sqrt(z * z - 4 * r * r));
        EXPECT_NEAR(radiance(ellipse({0, 0, 1.5f}, {0.5f, 0, 0}, {0, -0.5f, 0}), technique),
                    3 * of_disk * double{kFloorAlbedo}, 1e-5);
        const double distance = std::hypot(0.6, 1.5);
        const double of_sphere = 0.25 / (distance * distance) * 1.5 / distance;
        EXPECT_NEAR(radiance(sphere({0, 0, 1.5f}, 0.5f), technique), 3 * of_sphere * double{kFloorAlbedo},
                    1e-5);
    }
}

/// How many pixels of a floor with one sample each are black, though the light is above all of them.
std::size_t black_pixels(const RoundLight& light, Technique technique) {
    constexpr int kPixels = 32;
    scene::Scene scene = make_floor(1);
    add_round_light(scene, light);
    set_camera(scene, {0.6f, 0, 0.5f}, {0.6f, 0, 0}, {0, 1, 0}, 0.2, kPixels, kPixels);
    set_radius(scene);
    render::RenderSettings settings = settings_for(technique, Strategies::diffuse);
    settings.samples = 1;
    const image::Image image = render_cpu::Renderer(scene, 1).render(settings, base::choose_isa()).image;
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) count += image.pixels[i] > 0 ? 0 : 1;
    return count;
}

TEST(RoundLight, LosesNoSamplesBelowTheSurfaceByClippedSolidAngle) {
    RoundLight oblique = sphere({-0.4f, 0.1f, 0.05f}, 0.4f);
    oblique.w = {0.1f, 0, 0.2f};
    const RoundLight lights[] = {sphere({-0.4f, 0.1f, 0}, 0.3f), oblique,
                                 two_sided(ellipse({-0.4f, 0, 0.1f}, {0.1f, 0.3f, 0}, {0, 0, 0.3f}))};
    for (const RoundLight& light : lights) {
        EXPECT_EQ(black_pixels(light, Technique::clipped_solid_angle), 0u);
        EXPECT_GT(black_pixels(light, Technique::solid_angle), 100u);
    }
}

} // namespace
} // namespace nusselt::render_test
