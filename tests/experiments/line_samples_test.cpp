/// Line samples have the mean of point samples on the scenes of the repository.

#include "experiments/bias_statistics.h"
#include "render/film.h"
#include "render_cpu/renderer.h"
#include "scene/load.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace nusselt::experiments {
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
        scene::Scene scene =
            scene::load_scene(std::filesystem::path(NUSSELT_SOURCE_DIR) / "scenes" / (name + ".pbrt"));
        // Not square: in symmetrical scenes, pixel centres would be on edges between walls.
        render::resize_film(scene, 65, 48);
        return scene;
    }

    static BiasStatistics statistics_of(const render_cpu::Renderer& renderer, render::RenderSettings settings,
                                        int first_seed) {
        BiasStatistics statistics;
        for (int i = 0; i < kFrames; ++i) {
            settings.seed = static_cast<std::uint32_t>(first_seed + i);
            const auto result = renderer.render(settings, render_cpu::choose_isa());
            EXPECT_EQ(result.statistics.rejected_samples, 0u);
            statistics.add(result.image);
        }
        return statistics;
    }

    render::RenderSettings line_settings() const {
        render::RenderSettings settings = settings_;
        settings.integrator = render::Integrator::lines;
        settings.lines.count = 4;
        return settings;
    }

    scene::Scene scene_;
    render_cpu::Renderer renderer_;
    render::RenderSettings settings_;
};

TEST_P(LineSamplesOfScene, HaveTheMeanOfPoints) {
    const BiasStatistics reference = statistics_of(renderer_, settings_, 0);
    int seed = 1000;
    for (const auto choice : render::kManyOccludersChoices)
        // Noise of uniform offsets in highlights is far from normal.
        for (const auto offsets : {render::LineOffsets::length, render::LineOffsets::reflected}) {
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
    if (scene_.polygon_lights.empty()) GTEST_SKIP() << "there are no polygonal lights";
    scene::Scene dark = scene_;
    for (scene::PolygonLight& light : dark.polygon_lights)
        for (float* channel : {&light.radiance.x, &light.radiance.y, &light.radiance.z}) *channel *= 0.98f;
    const render_cpu::Renderer mutant(dark, render_cpu::default_thread_count());
    EXPECT_FALSE(statistics_of(mutant, line_settings(), 1000)
                     .compare(statistics_of(renderer_, settings_, 0))
                     .passes());
}

INSTANTIATE_TEST_SUITE_P(Shipped, LineSamplesOfScene,
                         testing::Values("biased", "bollards", "cornell-panel", "cornell-tube", "grid-planes",
                                         "logo", "planes", "ring", "room", "soup", "wall"),
                         [](const auto& test) {
                             std::string name = test.param;
                             for (char& c : name)
                                 if (c == '-') c = '_';
                             return name;
                         });

} // namespace
} // namespace nusselt::experiments
