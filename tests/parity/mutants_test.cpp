// The parity tests must reject wrong shaders.

#include "gpu_test.h"
#include "lab/parity/technique_parity.h"
#include "mutant.h"
#include "shaders/displaced_polygon.h"
#include "shaders/misinverted_polygon.h"
#include "shaders/perturbed_polygon.h"
#include "shaders/unguarded_polygon.h"

namespace nusselt::parity {

namespace {

using ProjectedPair = TechniquePair<hostile::PolygonProjectedSolidAngleKindOf<4>>;

class MutantParity : public GpuTest {
protected:
    template <class Pair>
    std::vector<std::string> excesses_of(const VariantShader& shader) const {
        return judge_twin<Pair>(device(), shader, kMutantLights).excesses;
    }
};

/// How many excesses start with a text.
auto count_of(const std::vector<std::string>& excesses, const std::string& begin) {
    return std::count_if(excesses.begin(), excesses.end(),
                         [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
}

TEST_F(MutantParity, RandomNumbersOffBySixteenRoundingsAreFound) {
    EXPECT_GT(count_of(excesses_of<ProjectedPair>(shaders::kPerturbedPolygon),
                       "decentral: first random number, median"),
              0);
}

TEST_F(MutantParity, HitPointsBehindTheLightAreFound) {
    const auto excesses = excesses_of<ProjectedPair>(shaders::kDisplacedPolygon);
    EXPECT_EQ(count_of(excesses, "decentral: hit point"), 3) << "all quantiles";
    EXPECT_EQ(count_of(excesses, "decentral:"), 3) << "everything else is correct";
}

TEST_F(MutantParity, WrongSecondInversesAreFound) {
    const auto excesses = excesses_of<ProjectedPair>(shaders::kMisinvertedPolygon);
    EXPECT_EQ(count_of(excesses, "decentral: second inverse"), 3) << "all quantiles";
    EXPECT_EQ(count_of(excesses, "decentral:"), 3) << "everything else is correct";
}

TEST_F(MutantParity, MissingClippingIsFound) {
    using Clipped = TechniquePair<hostile::PolygonClippedSolidAngleKindOf<4>>;
    const auto excesses =
        excesses_of<Clipped>(shader_of<TechniquePair<hostile::PolygonSolidAngleKindOf<4>>>(Variant::split));
    EXPECT_GT(count_of(excesses, "crossing the horizon:"), 0);
    EXPECT_EQ(count_of(excesses, "decentral:"), 0) << "lights above the horizon need no clipping";
}

TEST_F(MutantParity, InfiniteDensitiesAreFound) {
    const std::string violation =
        first_violation<ProjectedPair>(device(), shaders::kUnguardedPolygon, 20'000);
    EXPECT_NE(violation.find("the density of the sample is negative or not finite"), std::string::npos)
        << violation;
}

} // namespace

} // namespace nusselt::parity
