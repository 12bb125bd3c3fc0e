// Integrators are rows of a table: those of the renderer, and others that are a file and a row in toy_integrators.

#include "scenes.h"
#include "toy_integrators/rows.h"

#include "render_cpu/integrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nusselt {
namespace {

using base::Isa;
using render_cpu::Integrator;

std::vector<const Integrator*> all_integrators() {
    std::vector<const Integrator*> all;
    for (const Integrator& row : render_cpu::integrators()) all.push_back(&row);
    for (const Integrator& row : render_cpu::kToyIntegrators) all.push_back(&row);
    return all;
}

const Integrator& toy(const std::string& name) {
    for (const Integrator& row : render_cpu::kToyIntegrators)
        if (row.name == name) return row;
    throw std::invalid_argument("no toy " + name);
}

std::vector<Isa> supported_isas() {
    std::vector<Isa> isas;
    for (const Isa isa : base::kAllIsas)
        if (is_supported(isa)) isas.push_back(isa);
    return isas;
}

render::RenderSettings few_samples() {
    render::RenderSettings settings;
    settings.samples = 2;
    return settings;
}

TEST(Integrators, HaveNamesAndAKernelOfTheirOwnForEachInstructionSet) {
    std::set<std::string> names;
    std::set<render_cpu::RenderTile> kernels;
    for (const Integrator* row : all_integrators()) {
        EXPECT_TRUE(names.emplace(row->name).second) << row->name;
        for (const Isa isa : base::kAllIsas)
            EXPECT_TRUE(kernels.insert(kernel_for(*row, isa)).second) << row->name << " " << name_of(isa);
    }
    EXPECT_EQ(render_cpu::integrators().front().name, "direct_light");
}

TEST(Integrators, FinishFramesAndGiveTheSameImageAgain) {
    const scene::Scene scene = render_test::make_box_scene(24);
    for (const Integrator* row : all_integrators()) {
        const render_cpu::Renderer renderer(scene, 2, *row);
        for (const Isa isa : supported_isas()) {
            const render::RenderResult result = renderer.render(few_samples(), isa);
            EXPECT_EQ(result.finished_fraction, 1) << row->name;
            EXPECT_EQ(result.statistics.primary_rays, 2u * 24 * 24) << row->name;
            EXPECT_EQ(renderer.render(few_samples(), isa).image.pixels, result.image.pixels) << row->name;
            EXPECT_TRUE(std::any_of(result.image.pixels.begin(), result.image.pixels.end(), [](float value) {
                return value != 0;
            })) << row->name;
        }
    }
}

TEST(Integrators, NeedNoLights) {
    scene::Scene floor = render_test::make_floor(16);
    render_test::set_camera(floor, {0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 0.3, 16, 16);
    render_test::set_radius(floor);
    const render_cpu::Renderer renderer(floor, 1, toy("normals"));
    for (const Isa isa : supported_isas()) {
        const image::Image image = renderer.render({}, isa).image;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
            ASSERT_EQ(image.pixels[i], 0);
            ASSERT_EQ(image.pixels[i + 1], 0);
            ASSERT_EQ(image.pixels[i + 2], 1);
        }
    }
}

/// A floor with lights that the camera does not see.
scene::Scene lit_floor(const std::vector<float>& emissions) {
    scene::Scene scene = render_test::make_floor(16);
    render_test::set_camera(scene, {0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 0.3, 16, 16);
    for (std::size_t i = 0; i < emissions.size(); ++i) {
        const float height = 5 + static_cast<float>(i);
        render_test::add_polygon_light(
            scene, {scene::Float3{-2, -2, height}, {-2, 2, height}, {2, 2, height}, {2, -2, height}},
            {emissions[i], emissions[i], emissions[i]}, true, 0);
    }
    render_test::set_radius(scene);
    return scene;
}

TEST(Integrators, ChooseLightsByTheirSelector) {
    // Lights that do not shine still cast shadows, so that all shadow rays are the same.
    const scene::Scene both = lit_floor({3, 5});
    const scene::Scene last = lit_floor({0, 5});
    for (const Isa isa : supported_isas()) {
        const auto selected = render_cpu::Renderer(both, 1, toy("last_light")).render(few_samples(), isa);
        const auto expected = render_cpu::Renderer(last, 1).render(few_samples(), isa);
        EXPECT_EQ(selected.image.pixels, expected.image.pixels) << name_of(isa);
        EXPECT_LT(selected.statistics.shadow_rays, expected.statistics.shadow_rays) << name_of(isa);
        EXPECT_NE(render_cpu::Renderer(both, 1).render(few_samples(), isa).image.pixels,
                  selected.image.pixels)
            << name_of(isa);
    }
}

} // namespace
} // namespace nusselt
