/// Shading by integrals of linearly transformed cosines against what samples converge to, where nothing casts a shadow.

#include "scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace nusselt::render_test {
namespace {

using render::RenderSettings;
using render::Technique;

constexpr int kSize = 32;
constexpr float kRoughness = 0.6f;
constexpr Float3 kRadiance = {5, 5, 5};

/// Lights are out of sight, their highlights on the floor are not.
scene::Scene make_floor_in_view() {
    scene::Scene scene = make_floor(kSize);
    set_camera(scene, {0, -2, 1.5f}, {0, 0, 0}, {0, 0, 1}, 0.25, kSize, kSize);
    return scene;
}

scene::Scene under_panel() {
    scene::Scene scene = make_floor_in_view();
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_polygon_light(
        scene,
        {Float3{-0.5f, 0.6f, 1}, Float3{-0.5f, 1.4f, 1.2f}, Float3{0.6f, 1.4f, 1.2f}, Float3{0.6f, 0.6f, 1}},
        kRadiance, false, 1);
    return scene;
}

scene::Scene under_tube_of(scene::TubeModel model) {
    scene::Scene scene = make_floor_in_view();
    add_line_light(scene, "tube", {0, {-0.6f, 1, 0.6f}, {0.7f, 0.7f, 0.9f}, 0.01f, kRadiance, model});
    return scene;
}
scene::Scene under_thin_line() { return under_tube_of(scene::TubeModel::linear); }
scene::Scene under_tube() { return under_tube_of(scene::TubeModel::solid); }

/// The same with a specular component beside the diffuse one.
scene::Scene glossy(scene::Scene scene, float roughness) {
    scene.materials[0].model = scene::BrdfModel::frostbite;
    scene.materials[0].f0 = {0.2f, 0.2f, 0.2f};
    scene.materials[0].roughness = roughness;
    return scene;
}

image::Image rendered(const scene::Scene& scene, RenderSettings settings) {
    settings.pixel_position = render::PixelPosition::center;
    const auto result = render_cpu::Renderer(scene, 2).render(settings, base::choose_isa());
    EXPECT_EQ(result.statistics.rejected_samples, 0u);
    return result.image;
}

image::Image analytic(const scene::Scene& scene) {
    RenderSettings settings;
    settings.technique = Technique::ltc_analytic;
    return rendered(scene, settings);
}

image::Image converged(const scene::Scene& scene) {
    RenderSettings settings;
    settings.strategies = render::Strategies::diffuse_ltc;
    settings.samples = 256;
    return rendered(scene, settings);
}

/// Relative to the reference, the largest of all pixels.
double largest_error(const image::Image& image, const image::Image& reference) {
    double largest = 0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        const double expected = reference.pixels[i];
        EXPECT_GT(expected, 0);
        largest = std::max(largest, std::fabs(image.pixels[i] - expected) / expected);
    }
    return largest;
}

struct Case {
    const char* name;
    scene::Scene (*make_scene)();
    double matte_limit;
};

class Analytic : public testing::TestWithParam<Case> {
protected:
    scene::Scene scene_ = GetParam().make_scene();
};

TEST_P(Analytic, MatteFloorIsExactUpToTheModelOfTheLight) {
    EXPECT_LT(largest_error(analytic(scene_), converged(scene_)), GetParam().matte_limit);
}

/// The misfit of lobes for the specular component, and for a diffuse component that is not quite Lambertian.
constexpr double kLargestMisfit = 0.06;

TEST_P(Analytic, GlossyFloorIsAsGoodAsFits) {
    const scene::Scene scene = glossy(scene_, kRoughness);
    EXPECT_LT(largest_error(analytic(scene), converged(scene)), kLargestMisfit);
}

/// The test of the test.
TEST_P(Analytic, AnotherRoughnessIsNoticed) {
    const image::Image reference = converged(glossy(scene_, kRoughness));
    for (const float step : {-0.1f, 0.1f})
        EXPECT_GT(largest_error(analytic(glossy(scene_, kRoughness + step)), reference), 2 * kLargestMisfit)
            << step;
}

// The integral over a tube is that of a line, which is off by about its radius over its distance.
INSTANTIATE_TEST_SUITE_P(Lights, Analytic,
                         testing::Values(Case{"panel", under_panel, 1e-4},
                                         Case{"line", under_thin_line, 1e-4}, Case{"tube", under_tube, 0.03}),
                         [](const auto& test) { return test.param.name; });

} // namespace
} // namespace nusselt::render_test
