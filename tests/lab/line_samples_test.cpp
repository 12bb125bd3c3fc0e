/// Line samples have the mean of point samples on the scenes of the repository.

#include "common/source_folder.h"
#include "lab/errors/bias_statistics.h"
#include "render/film.h"
#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace nusselt::lab {
namespace {

constexpr int kFrames = 40;

class LineSamplesOfScene : public testing::TestWithParam<const char*> {
protected:
    LineSamplesOfScene()
        : scene_(load_small(GetParam())), renderer_(scene_, render_cpu::default_thread_count()) {
        settings_.samples = 4;
        settings_.strategies = render::Strategies::diffuse_ltc;
    }

    static scene::Scene load_small(const std::string& name) {
        scene::Scene scene = scene::load_scene(std::filesystem::path(nusselt_test::kSourceFolder) / "scenes" /
                                               (name + ".pbrt"));
        // Not square: in symmetrical scenes, pixel centres would be on edges between walls.
        render::resize_film(scene, 65, 48);
        return scene;
    }

    static BiasStatistics statistics_of(const render_cpu::Renderer& renderer, render::RenderSettings settings,
                                        int first_seed) {
        BiasStatistics statistics;
        for (int i = 0; i < kFrames; ++i) {
            settings.seed = static_cast<std::uint32_t>(first_seed + i);
            const auto result = renderer.render(settings, base::choose_isa());
            EXPECT_EQ(result.statistics.rejected_samples, 0u);
            if (settings.light_samples == render::LightSamples::lines) {
                EXPECT_GT(result.statistics.lines.lines, 0u);
            }
            statistics.add(result.image);
        }
        return statistics;
    }

    render::RenderSettings line_settings() const {
        render::RenderSettings settings = settings_;
        settings.light_samples = render::LightSamples::lines;
        settings.lines.count = 16;
        return settings;
    }

    bool has_highlights() const {
        return std::any_of(
            scene_.materials.begin(), scene_.materials.end(),
            [](const scene::Material& material) { return material.model != scene::BrdfModel::lambert; });
    }

    scene::Scene scene_;
    render_cpu::Renderer renderer_;
    render::RenderSettings settings_;
};

TEST_P(LineSamplesOfScene, HaveTheMeanOfPoints) {
    const BiasStatistics reference = statistics_of(renderer_, settings_, 0);
    int seed = 1000;
    for (const auto choice : render::kManyOccludersChoices)
        for (const auto offsets : render::kLineOffsets) {
            // Its noise in highlights is far from normal.
            if (offsets == render::LineOffsets::uniform && has_highlights()) continue;
            render::RenderSettings settings = line_settings();
            settings.lines.offsets = offsets;
            settings.lines.many_occluders = choice;
            const BiasTest test = statistics_of(renderer_, settings, seed += 1000).compare(reference);
            EXPECT_TRUE(test.passes())
                << name_of(offsets) << ", " << name_of(choice) << ": frame " << test.frame << ", cell "
                << test.largest_cell << ", sum of squares " << test.chi_square;
        }
}

/// The test of the test: lights that are two per cent darker.
TEST_P(LineSamplesOfScene, ThatAreTooDarkAreRejected) {
    scene::Scene dark = scene_;
    for (scene::PolygonLight& light : dark.lights.of<scene::PolygonLight>())
        for (float* channel : {&light.radiance.x, &light.radiance.y, &light.radiance.z}) *channel *= 0.98f;
    const render_cpu::Renderer mutant(dark, render_cpu::default_thread_count());
    render::RenderSettings settings = line_settings();
    settings.lines.many_occluders = render::ManyOccluders::lines;
    EXPECT_FALSE(
        statistics_of(mutant, settings, 1000).compare(statistics_of(renderer_, settings_, 0)).passes());
}

INSTANTIATE_TEST_SUITE_P(Shipped, LineSamplesOfScene,
                         testing::Values("biased", "cornell-panel", "grid-planes", "logo", "planes", "ring",
                                         "room", "soup", "wall"),
                         [](const auto& test) {
                             std::string name = test.param;
                             for (char& c : name)
                                 if (c == '-') c = '_';
                             return name;
                         });

} // namespace
} // namespace nusselt::lab
