/// With random positions in pixels, images of both renderers have the same mean.

#include "common/source_folder.h"
#include "comparison.h"
#include "gpu_test.h"
#include "lab/errors/bias_statistics.h"
#include "render/film.h"
#include "rich_scene.h"
#include "scene/import/importers.h"

#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using lab::BiasStatistics;
using render_vulkan::ShadowRays;
using render_vulkan::VulkanRenderer;

constexpr int kFrames = 16;
constexpr int kWidth = 64;
constexpr int kHeight = 48;

render::RenderSettings settings_for(std::uint32_t seed) {
    render::RenderSettings settings;
    settings.strategies = render::Strategies::diffuse_ltc;
    // textured_lights_test.cpp compares cells, whose shaders take long to compile.
    settings.emission_sampling = render::EmissionSampling::measure;
    // All pixels of a frame share their offset: with few frames, edges would not be independent of each other.
    settings.samples = 16;
    settings.seed = seed;
    return settings;
}

BiasStatistics of_gpu(VulkanRenderer&& renderer) {
    BiasStatistics statistics;
    for (std::uint32_t seed = 0; seed < kFrames; ++seed)
        statistics.add(renderer.render(settings_for(seed)).image);
    return statistics;
}

BiasStatistics of_cpu(const scene::Scene& scene) {
    const render_cpu::Renderer renderer(scene, 2);
    BiasStatistics statistics;
    for (std::uint32_t seed = 0; seed < kFrames; ++seed)
        statistics.add(renderer.render(settings_for(1000 + seed), base::choose_isa()).image);
    return statistics;
}

class Bias : public parity::GpuTest {
protected:
    /// Compares with each way to trace shadow rays that the device supports.
    std::vector<lab::BiasTest> compare(const scene::Scene& scene) const {
        std::vector<lab::BiasTest> tests;
        const BiasStatistics expected = of_cpu(scene);
        for (const ShadowRays way : {ShadowRays::bvh, ShadowRays::query})
            if (way != ShadowRays::query || device().features().ray_queries)
                tests.push_back(of_gpu(VulkanRenderer(device(), scene, way)).compare(expected));
        return tests;
    }
};

void expect_none(const lab::BiasTest& test) {
    EXPECT_TRUE(test.passes()) << "frame " << test.frame << ", cell " << test.largest_cell << ", chi^2 "
                               << test.chi_square << " of " << test.cells;
}

void expect_none(const std::vector<lab::BiasTest>& tests) {
    for (const lab::BiasTest& test : tests) expect_none(test);
}

const scene::PixelFilter kWideFilter = {.kind = scene::FilterKind::mitchell, .radius_x = 2, .radius_y = 2};

/// With a wide filter, the offset that all pixels of a frame share causes most of the noise: cells are not independent,
/// and their sum of squares means nothing. The others hold all the same.
void leave_out_sum_of_squares(lab::BiasTest& test) { test.chi_square = 0; }

TEST_F(Bias, OfShippedScenes_ThereIsNone) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(nusselt_test::kSourceFolder) + "/scenes")) {
        if (entry.path().extension() != ".pbrt") continue;
        SCOPED_TRACE(entry.path().filename());
        scene::Scene scene = scene::load_scene(entry.path());
        render::resize_film(scene, kWidth, kHeight);
        expect_none(compare(scene));
    }
}

TEST_F(Bias, OfAllThatSurfacesCanHave_ThereIsNone) {
    scene::Scene scene = make_rich_scene(kWidth, kHeight);
    scene.film.filter = kWideFilter;
    std::vector<lab::BiasTest> tests = compare(scene);
    for (lab::BiasTest& test : tests) leave_out_sum_of_squares(test);
    expect_none(tests);
}

TEST_F(Bias, OfBathroom_ThereIsNone) {
    const char* folder = std::getenv("NUSSELT_SCENES");
    if (folder == nullptr) GTEST_SKIP() << "set NUSSELT_SCENES to the folder with bathroom/";
    scene::Scene scene = scene::load_scene(std::filesystem::path(folder) / "bathroom/bathroom.pbrt");
    render::resize_film(scene, kWidth, kHeight);
    expect_none(compare(scene));
}

/// The test of the test.
TEST_F(Bias, OfADimmedLight_IsFound) {
    // With a wide filter and without the sum of squares, the test is less sensitive.
    for (const auto& [filter, factor] :
         {std::pair(scene::PixelFilter(), 0.97f), std::pair(kWideFilter, 0.8f)}) {
        scene::Scene scene = make_rich_scene(kWidth, kHeight);
        scene.film.filter = filter;
        const BiasStatistics reference = of_cpu(scene);
        for (scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>())
            for (float* channel : {&light.radiance.x, &light.radiance.y, &light.radiance.z})
                *channel *= factor;
        lab::BiasTest test = of_gpu(VulkanRenderer(device(), scene, ShadowRays::bvh)).compare(reference);
        if (filter.kind != scene::FilterKind::box) leave_out_sum_of_squares(test);
        EXPECT_FALSE(test.passes()) << factor;
    }
}

} // namespace
} // namespace nusselt::render_vulkan_test
