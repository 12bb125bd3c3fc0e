/// Published scenes at full size, where they are at hand: the environment variable NUSSELT_SCENES names the
/// folder with bathroom/ and sponza/.

#include "scenes.h"

#include "image/metrics.h"
#include "scene/load.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace nusselt::render_test {
namespace {

using render_cpu::Technique;

class RealScene : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const char* const folder = std::getenv("NUSSELT_SCENES");
        if (folder == nullptr) GTEST_SKIP() << "set NUSSELT_SCENES to the folder with bathroom/ and sponza/";
        scene_ = scene::load_scene(std::filesystem::path(folder) / GetParam());
    }

    scene::Scene scene_;
};

TEST_P(RealScene, EachTechniqueGivesValidPixels) {
    const render_cpu::Renderer renderer(scene_, render_cpu::default_thread_count());
    for (const Technique technique : render_cpu::kTechniques) {
        render_cpu::RenderSettings settings;
        settings.technique = technique;
        const render_cpu::RenderResult result = renderer.render(settings, render_cpu::choose_isa());
        EXPECT_EQ(result.statistics.rejected_samples, 0u) << render_cpu::name_of(technique);
        EXPECT_EQ(image::compare(result.image, result.image).invalid_a.count, 0)
            << render_cpu::name_of(technique);
    }
}

// 256 samples per pixel in kSeeds independent images. Seen from the camera, techniques differ most near the
// lights: regions are compared, not only the mean of the image.
TEST_P(RealScene, TechniquesHaveTheSameMean) {
    const render_cpu::Renderer renderer(scene_, render_cpu::default_thread_count());
    const auto tracer = renderer.visibility().tracer();
    render_cpu::RenderSettings settings;
    settings.samples = 256 / kSeeds;
    settings.camera_rays = 1;
    settings.pixel_position = render_cpu::PixelPosition::center;
    settings.technique = Technique::projected_solid_angle;
    const auto reference = render_region_means(renderer, settings, kSeeds, tracer);
    for (const Technique technique :
         {Technique::area, Technique::solid_angle, Technique::clipped_solid_angle}) {
        settings.technique = technique;
        EXPECT_LT(largest_t(render_region_means(renderer, settings, kSeeds, tracer), reference), kLargestT)
            << render_cpu::name_of(technique);
    }
}

INSTANTIATE_TEST_SUITE_P(Published, RealScene,
                         testing::Values("bathroom/bathroom.pbrt", "sponza/sponza.pbrt",
                                         "sponza/sponza-small-light.pbrt"),
                         [](const auto& scene) {
                             std::string name = std::filesystem::path(scene.param).stem().string();
                             for (char& c : name)
                                 if (c == '-') c = '_';
                             return name;
                         });

} // namespace
} // namespace nusselt::render_test
