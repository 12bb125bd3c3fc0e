/// Published scenes at full size, where they are available: the environment variable NUSSELT_SCENES names the
/// folder with bathroom/ and sponza/.

#include "common/effort.h"
#include "common/source_folder.h"
#include "scenes.h"

#include "image/metrics.h"
#include "render/film.h"
#include "scene/import/importers.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace nusselt::render_test {
namespace {

using render::Technique;

class ScenesFolder : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (std::getenv("NUSSELT_SCENES") == nullptr)
            GTEST_SKIP() << "set NUSSELT_SCENES to the folder with bathroom/ and sponza/";
    }

    static scene::Scene load(const std::string& name) {
        return scene::load_scene(std::filesystem::path(std::getenv("NUSSELT_SCENES")) / name);
    }
};

class RealScene : public ScenesFolder {
protected:
    void SetUp() override {
        ScenesFolder::SetUp();
        if (!IsSkipped()) scene_ = load(GetParam());
    }

    scene::Scene scene_;
};

class RealSceneWithRig : public ScenesFolder {};

/// Small images of all techniques under a rig of the repository.
TEST_P(RealSceneWithRig, EachTechniqueGivesValidPixels) {
    const std::string rig = GetParam();
    const std::string name = rig.substr(0, rig.find('-'));
    scene::Scene scene = load(name + "/" + name + ".pbrt");
    scene::apply_rig(
        scene::read_rig(std::filesystem::path(nusselt_test::kSourceFolder) / "scenes/rigs" / (rig + ".json")),
        scene);
    render::resize_film(scene, 48, 32);
    const render_cpu::Renderer renderer(scene, render_cpu::default_thread_count());
    for (const Technique technique : render::kTechniques) {
        render::RenderSettings settings;
        settings.technique = technique;
        const render::RenderResult result = renderer.render(settings, base::choose_isa());
        EXPECT_EQ(image::compare(result.image, result.image).invalid_a.count, 0)
            << render::name_of(technique);
        EXPECT_TRUE(std::any_of(result.image.pixels.begin(), result.image.pixels.end(), [](float value) {
            return value > 0;
        })) << render::name_of(technique);
    }
}

std::string test_name(const testing::TestParamInfo<const char*>& scene) {
    std::string name = std::filesystem::path(scene.param).stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Published, RealSceneWithRig,
                         testing::Values("bathroom-hundred", "bathroom-panel", "bathroom-tube",
                                         "sponza-hundred", "sponza-panel", "sponza-tube"),
                         test_name);

TEST_P(RealScene, EachTechniqueGivesValidPixels) {
    const render_cpu::Renderer renderer(scene_, render_cpu::default_thread_count());
    for (const Technique technique : render::kTechniques) {
        render::RenderSettings settings;
        settings.technique = technique;
        const render::RenderResult result = renderer.render(settings, base::choose_isa());
        EXPECT_EQ(result.statistics.rejected_samples, 0u) << render::name_of(technique);
        EXPECT_EQ(image::compare(result.image, result.image).invalid_a.count, 0)
            << render::name_of(technique);
    }
}

// 64 samples per pixel, 256 at full effort, in kSeeds independent images. Seen from the camera, techniques differ most near the
// lights: regions are compared, not only the mean of the image.
TEST_P(RealScene, TechniquesHaveTheSameMean) {
    const render_cpu::Renderer renderer(scene_, render_cpu::default_thread_count());
    const auto tracer = renderer.visibility().tracer();
    render::RenderSettings settings;
    settings.samples = nusselt_test::at_effort(64, 256) / kSeeds;
    settings.camera_rays = 1;
    settings.pixel_position = render::PixelPosition::center;
    settings.technique = Technique::projected_solid_angle;
    const auto reference = render_region_means(renderer, settings, kSeeds, tracer);
    for (const Technique technique :
         {Technique::area, Technique::solid_angle, Technique::clipped_solid_angle}) {
        settings.technique = technique;
        EXPECT_LT(largest_t(render_region_means(renderer, settings, kSeeds, tracer), reference), kLargestT)
            << render::name_of(technique);
    }
}

INSTANTIATE_TEST_SUITE_P(Published, RealScene,
                         testing::Values("bathroom/bathroom.pbrt", "sponza/sponza.pbrt",
                                         "sponza/sponza-small-light.pbrt"),
                         test_name);

} // namespace
} // namespace nusselt::render_test
