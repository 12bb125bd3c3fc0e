/// Line samples against point samples in published scenes at full complexity. The environment variable NUSSELT_SCENES names
/// the folder with bathroom/ and sponza/.

#include "lab/errors/bias_statistics.h"
#include "lab/errors/image_errors.h"
#include "lab/errors/noise_curve.h"

#include "render/film.h"
#include "scene/import/importers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace nusselt::lab {

namespace {

using render::LightSamples;
using render::LineShading;
using render::ManyOccluders;
using render::RenderSettings;

constexpr int kFrames = 24;

RenderSettings point_settings() {
    RenderSettings settings;
    settings.samples = 64;
    // Some materials are nearly mirrors: points by the cosine alone have no normal noise there.
    settings.strategies = render::Strategies::diffuse_ltc;
    settings.camera_rays = 1;
    settings.pixel_position = render::PixelPosition::center;
    settings.sample_order = render::SampleOrder::stratified;
    return settings;
}

RenderSettings line_settings(LineShading shading, ManyOccluders many_occluders) {
    RenderSettings settings = point_settings();
    settings.samples = 1;
    settings.light_samples = LightSamples::lines;
    settings.lines.count = 16;
    settings.lines.shading = shading;
    settings.lines.many_occluders = many_occluders;
    settings.seed = 1000; // other numbers than those of points
    return settings;
}

class RealSceneLines : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const char* const folder = std::getenv("NUSSELT_SCENES");
        if (folder == nullptr) GTEST_SKIP() << "set NUSSELT_SCENES to the folder with bathroom/ and sponza/";
        scene_ = scene::load_scene(std::filesystem::path(folder) / GetParam());
        render::resize_film(scene_, 64, 48);
    }

    static BiasStatistics frames(const scene::Scene& scene, RenderSettings settings) {
        const render_cpu::Renderer renderer(scene, render_cpu::default_thread_count());
        BiasStatistics statistics;
        for (int i = 0; i < kFrames; ++i, ++settings.seed) {
            const render::RenderResult result = renderer.render(settings, base::choose_isa());
            EXPECT_EQ(result.statistics.rejected_samples, 0u);
            if (settings.light_samples == LightSamples::lines) {
                EXPECT_GT(result.statistics.lines.lines, 0u);
                if (settings.lines.many_occluders == ManyOccluders::points) {
                    EXPECT_GT(result.statistics.lines.point_lights, 0u);
                }
            }
            statistics.add(result.image);
        }
        return statistics;
    }

    scene::Scene scene_;
};

std::string to_text(const BiasTest& test) {
    return "frame " + std::to_string(test.frame) + ", largest cell " + std::to_string(test.largest_cell) +
           ", chi-square " + std::to_string(test.chi_square) + " of " + std::to_string(test.cells) +
           ", share of pixels beyond three standard deviations " + std::to_string(test.pixels_beyond_three);
}

TEST_P(RealSceneLines, HaveTheMeanOfPoints) {
    const BiasStatistics points = frames(scene_, point_settings());
    for (const ManyOccluders many_occluders : {ManyOccluders::lines, ManyOccluders::points}) {
        const BiasTest test =
            frames(scene_, line_settings(LineShading::unbiased, many_occluders)).compare(points);
        EXPECT_TRUE(test.passes()) << to_text(test);
    }
}

/// The test of the test: the light a twentieth of its width to the side.
TEST_P(RealSceneLines, AreRejectedForAnotherLight) {
    const BiasStatistics points = frames(scene_, point_settings());
    scene::Scene other = scene_;
    for (scene::PolygonLight& light : other.lights.of<scene::PolygonLight>()) {
        const scene::Float3 a = light.vertices[0];
        const scene::Float3 b = light.vertices[1];
        for (scene::Float3& v : light.vertices) {
            v.x += 0.05f * (b.x - a.x);
            v.y += 0.05f * (b.y - a.y);
            v.z += 0.05f * (b.z - a.z);
        }
    }
    const BiasTest test =
        frames(other, line_settings(LineShading::unbiased, ManyOccluders::lines)).compare(points);
    EXPECT_FALSE(test.passes()) << to_text(test);
}

TEST_P(RealSceneLines, AnalyticOnesHaveASmallBias) {
    const render_cpu::Renderer renderer(scene_, render_cpu::default_thread_count());
    const base::Isa isa = base::choose_isa();
    const auto render = [&](LineShading shading) {
        return render_seeds(renderer, isa, line_settings(shading, ManyOccluders::lines), kFrames);
    };
    const SeedStatistics analytic = render(LineShading::analytic);
    const SeedStatistics unbiased = render(LineShading::unbiased);
    const double radiance = mean_radiance(unbiased.mean);
    const double noise = (analytic.variance + unbiased.variance) / kFrames;
    const double square = mean_square_difference(analytic.mean, unbiased.mean);
    const double frame_bias = mean_radiance(analytic.mean) / radiance - 1;
    const double pixel_bias = std::sqrt(std::max(square - noise, 0.0)) / radiance;
    RecordProperty("frame_bias", std::to_string(frame_bias));
    RecordProperty("pixel_bias", std::to_string(pixel_bias));
    EXPECT_LT(std::abs(frame_bias), 0.01);
    EXPECT_LT(pixel_bias, 0.03);
}

std::string test_name(const testing::TestParamInfo<const char*>& scene) {
    std::string name = std::filesystem::path(scene.param).stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Published, RealSceneLines,
                         testing::Values("bathroom/bathroom.pbrt", "sponza/sponza.pbrt",
                                         "sponza/sponza-small-light.pbrt"),
                         test_name);

} // namespace

} // namespace nusselt::lab
