// The parity tests must reject wrong shaders.

#include "lab/parity/technique_parity.h"
#include "mutant.h"
#include "platform_test.h"
#include "shaders/displaced_polygon.h"
#include "shaders/misinverted_polygon.h"
#include "shaders/perturbed_polygon.h"
#include "shaders/unguarded_polygon.h"

namespace nusselt::parity {

namespace {

using ProjectedPair = TechniquePair<hostile::PolygonProjectedSolidAngleKindOf<4>>;

class MutantParity : public PlatformTest {
protected:
    template <class Pair>
    auto excesses_of(const std::vector<VariantShader>& shaders) const {
        return excesses_of_each(shaders, judge_twins<Pair>(platform(), shaders, kMutantLights));
    }
};

/// How many excesses start with a text.
auto count_of(const std::vector<std::string>& excesses, const std::string& begin) {
    return std::count_if(excesses.begin(), excesses.end(),
                         [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
}

TEST_F(MutantParity, RandomNumbersOffBySixteenRoundingsAreFound) {
    for (const auto& [variant, excesses] :
         excesses_of<ProjectedPair>(wherever_it_runs({"perturbed_polygon", shaders::kPerturbedPolygon}))) {
        SCOPED_TRACE(name_of(variant));
        EXPECT_GT(count_of(excesses, "decentral: first random number, median"), 0);
    }
}

TEST_F(MutantParity, HitPointsBehindTheLightAreFound) {
    for (const auto& [variant, excesses] :
         excesses_of<ProjectedPair>(wherever_it_runs({"displaced_polygon", shaders::kDisplacedPolygon}))) {
        SCOPED_TRACE(name_of(variant));
        EXPECT_EQ(count_of(excesses, "decentral: hit point"), 3) << "all quantiles";
        EXPECT_EQ(count_of(excesses, "decentral:"), 3) << "everything else is correct";
    }
}

TEST_F(MutantParity, WrongSecondInversesAreFound) {
    for (const auto& [variant, excesses] : excesses_of<ProjectedPair>(
             wherever_it_runs({"misinverted_polygon", shaders::kMisinvertedPolygon}))) {
        SCOPED_TRACE(name_of(variant));
        EXPECT_EQ(count_of(excesses, "decentral: second inverse"), 3) << "all quantiles";
        EXPECT_EQ(count_of(excesses, "decentral:"), 3) << "everything else is correct";
    }
}

TEST_F(MutantParity, MissingClippingIsFound) {
    using Clipped = TechniquePair<hostile::PolygonClippedSolidAngleKindOf<4>>;
    const Shader unclipped =
        shader_of<TechniquePair<hostile::PolygonSolidAngleKindOf<4>>>(Variant::split).shader;
    for (const auto& [variant, excesses] : excesses_of<Clipped>(wherever_it_runs(unclipped))) {
        SCOPED_TRACE(name_of(variant));
        EXPECT_GT(count_of(excesses, "crossing the horizon:"), 0);
        EXPECT_EQ(count_of(excesses, "decentral:"), 0) << "lights above the horizon need no clipping";
    }
}

TEST_F(MutantParity, InfiniteDensitiesAreFound) {
    for (const auto& shader : wherever_it_runs({"unguarded_polygon", shaders::kUnguardedPolygon})) {
        SCOPED_TRACE(name_of(shader.variant));
        const std::string violation = first_violation<ProjectedPair>(platform(), shader, 20'000);
        EXPECT_NE(violation.find("the density of the sample is negative or not finite"), std::string::npos)
            << violation;
    }
}

} // namespace

} // namespace nusselt::parity
