#include "common/source_folder.h"
#include "image/metrics.h"
#include "lab/figures/technique_image.h"
#include "render/film.h"
#include "scene/import/importers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using render::Technique;

scene::Scene small_scene(const std::string& name) {
    scene::Scene scene =
        scene::load_scene(std::filesystem::path(nusselt_test::kSourceFolder) / "scenes" / name);
    render::resize_film(scene, 96, 96);
    return scene;
}

image::Image rendered(const render_cpu::Renderer& renderer, Technique technique, int samples) {
    render::RenderSettings settings;
    settings.technique = technique;
    settings.samples = samples;
    settings.pixel_position = render::PixelPosition::center;
    settings.sample_order = samples > 1 ? render::SampleOrder::sobol : render::SampleOrder::independent;
    return renderer.render(settings, base::choose_isa()).image;
}

struct Pair {
    const char* scene;
    const char* technique;
    Technique setting;
};
constexpr Pair kPairs[] = {
    {"cornell-tube.pbrt", "LineArea", Technique::area},
    {"cornell-tube.pbrt", "LineSolidAngle", Technique::solid_angle},
    {"cornell-tube.pbrt", "LineProjectedSolidAngle", Technique::projected_solid_angle},
    {"cornell-panel.pbrt", "PolygonArea", Technique::area},
    {"cornell-panel.pbrt", "PolygonClippedSolidAngle", Technique::clipped_solid_angle},
    {"cornell-panel.pbrt", "PolygonProjectedSolidAngle", Technique::projected_solid_angle},
};

// With the same random numbers, only shadow rays that graze an edge may differ.
TEST(TechniqueImages, AreThoseOfTheRenderer) {
    for (const Pair& pair : kPairs) {
        const scene::Scene scene = small_scene(pair.scene);
        const render_cpu::Renderer renderer(scene, 2);
        const image::Image image = TechniqueImages(scene, renderer).render(pair.technique, 0);
        const image::Image expected = rendered(renderer, pair.setting, 1);
        EXPECT_LT(image::differing_share(image, expected, 1e-3, 1e-2), 0.005) << pair.technique;
    }
}

// Other random numbers, and another technique, are noticed.
TEST(TechniqueImages, DifferWithSeedAndTechnique) {
    const scene::Scene scene = small_scene("cornell-panel.pbrt");
    const render_cpu::Renderer renderer(scene, 2);
    const TechniqueImages images(scene, renderer);
    const image::Image expected = rendered(renderer, Technique::area, 1);
    EXPECT_GT(image::differing_share(images.render("PolygonArea", 1), expected, 1e-3, 1e-2), 0.5);
    EXPECT_GT(image::differing_share(images.render("PolygonSolidAngle", 0), expected, 1e-3, 1e-2), 0.5);
}

// Published methods have the same mean, within four standard errors of the mean over frames.
TEST(TechniqueImages, OfPublishedMethodsAreUnbiased) {
    constexpr int kFrames = 16;
    struct Row {
        const char* scene;
        std::vector<const char*> techniques;
    };
    const Row rows[] = {
        {"cornell-tube.pbrt",
         {"LineClippedLinearWarpHart", "LineClippedQuadraticWarpHart", "LineProjectedSolidAngleLi"}},
        {"cornell-panel.pbrt",
         {"RectangleSolidAngle", "PolygonSolidAngleArvo", "PolygonBilinearWarpHart",
          "PolygonClippedBiquadraticWarpHart", "PolygonProjectedSolidAngleArvo",
          "PolygonProjectedSolidAngleBisection", "PolygonSubdivisionUrena"}}};
    for (const Row& row : rows) {
        const scene::Scene scene = small_scene(row.scene);
        const render_cpu::Renderer renderer(scene, 2);
        const TechniqueImages images(scene, renderer);
        const image::Image reference = rendered(renderer, Technique::projected_solid_angle, 256);
        for (const char* const technique : row.techniques) {
            double mean = 0, squares = 0;
            double expected = 0;
            for (int i = 0; i < kFrames; ++i) {
                const image::Comparison c =
                    image::compare(images.render(technique, static_cast<std::uint32_t>(i)), reference);
                EXPECT_EQ(c.invalid_a.count, 0) << technique;
                const double deviation = c.mean_a - mean;
                mean += deviation / (i + 1);
                squares += deviation * (c.mean_a - mean);
                expected = c.mean_b;
            }
            const double error = std::sqrt(squares / (kFrames - 1) / kFrames);
            EXPECT_NEAR(mean, expected, 4 * error + 1e-3 * expected) << technique;
            EXPECT_LT(error, 0.01 * expected) << technique;
        }
    }
}

TEST(TechniqueImages, RejectOtherScenesAndTechniques) {
    const scene::Scene panel = small_scene("cornell-panel.pbrt");
    const render_cpu::Renderer renderer(panel, 2);
    const TechniqueImages images(panel, renderer);
    EXPECT_THROW(images.render("LineArea", 0), std::invalid_argument);
    EXPECT_THROW(images.render("", 0), std::invalid_argument);
    const scene::Scene room = small_scene("room.pbrt");
    EXPECT_FALSE(has_one_light(room));
    EXPECT_THROW(TechniqueImages(room, renderer), std::invalid_argument);
}

} // namespace

} // namespace nusselt::lab
