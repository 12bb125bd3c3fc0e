/// All techniques have the same expectation, also with occluders and glossy surfaces.

#include "lossy_tracer.h"
#include "scenes.h"

#include <gtest/gtest.h>

namespace nusselt::render_test {
namespace {

using render::Technique;

constexpr int kSize = 32;
constexpr int kSamples = 16;

class TechniqueAgreement : public testing::Test {
protected:
    TechniqueAgreement() : scene_(make_box_scene(kSize)), renderer_(scene_, 2) {
        settings_.samples = kSamples;
        settings_.camera_rays = 1;
        // Stratified in the pixel, camera rays are noisier than light samples: they cancel in differences.
        settings_.pixel_position = render::PixelPosition::center;
    }

    std::vector<std::vector<double>> rows(Technique technique, const visibility::RayTracer& tracer) {
        settings_.technique = technique;
        return render_region_means(renderer_, settings_, kSeeds, tracer);
    }

    scene::Scene scene_;
    render_cpu::Renderer renderer_;
    render::RenderSettings settings_;
};

TEST_F(TechniqueAgreement, SameExpectation) {
    const auto tracer = renderer_.visibility().tracer();
    for (const auto order : render::kSampleOrders) {
        settings_.sample_order = order;
        const auto reference = rows(Technique::projected_solid_angle, tracer);
        for (const Technique technique :
             {Technique::area, Technique::solid_angle, Technique::clipped_solid_angle})
            EXPECT_LT(largest_t(rows(technique, tracer), reference), kLargestT)
                << render::name_of(technique) << ", " << render::name_of(order);
    }
}

TEST_F(TechniqueAgreement, TwoTechniquesHaveTheSameExpectationWithEachHeuristic) {
    const auto tracer = renderer_.visibility().tracer();
    const auto reference = rows(Technique::projected_solid_angle, tracer);
    // Far from what it should be, and yet without bias.
    settings_.visibility_estimate = 0.8f;
    for (const auto technique : {Technique::projected_solid_angle, Technique::solid_angle})
        for (const auto strategies : render::kStrategies)
            for (const auto mis : render::kMisHeuristics) {
                if (strategies == render::Strategies::diffuse || !allows(technique, strategies) ||
                    !allows(strategies, mis))
                    continue;
                settings_.strategies = strategies;
                settings_.mis = mis;
                EXPECT_LT(largest_t(rows(technique, tracer), reference), kLargestT)
                    << render::name_of(technique) << ", " << render::name_of(strategies) << ", "
                    << render::name_of(mis);
            }
}

/// The test of the test, for optimal MIS, whose estimate does not come from shadow rays alone.
TEST_F(TechniqueAgreement, RejectsTwoTechniquesThatAreTooDark) {
    const auto tracer = renderer_.visibility().tracer();
    const LossyTracer mutant(tracer, 0.03);
    const auto reference = rows(Technique::projected_solid_angle, tracer);
    settings_.strategies = render::Strategies::diffuse_ltc;
    settings_.mis = render::Mis::optimal;
    EXPECT_GT(largest_t(rows(Technique::projected_solid_angle, mutant.tracer()), reference), kLargestT);
}

TEST_F(TechniqueAgreement, ManyCameraRaysHaveTheSameExpectation) {
    const auto tracer = renderer_.visibility().tracer();
    settings_.pixel_position = render::PixelPosition::jittered;
    settings_.camera_rays = kSamples;
    const auto one_light_sample = rows(Technique::projected_solid_angle, tracer);
    settings_.camera_rays = kSamples / 4;
    const auto four_light_samples = rows(Technique::solid_angle, tracer);
    EXPECT_LT(largest_t(one_light_sample, four_light_samples), kLargestT);
}

/// The test of the test: three per cent of the light of one technique are missing.
TEST_F(TechniqueAgreement, RejectsATechniqueThatIsTooDark) {
    const auto tracer = renderer_.visibility().tracer();
    const LossyTracer mutant(tracer, 0.03);
    const auto reference = rows(Technique::projected_solid_angle, tracer);
    EXPECT_GT(largest_t(rows(Technique::solid_angle, mutant.tracer()), reference), kLargestT);
}

} // namespace
} // namespace nusselt::render_test
