// Techniques for cylinders, and a wrong one.

#include "cylinder_parity.h"
#include "shaders/lidless_cylinder.h"

namespace nusselt::parity {

namespace {

// Named types, for the names of tests.
struct CylinderArea : CylinderAreaPair {};
struct CylinderSolidAngle : CylinderSolidAnglePair {};
struct CylinderProjectedSolidAngle : CylinderProjectedSolidAnglePair {};
struct CylinderLtc : CylinderLtcPair {};

template <class Pair>
class CylinderParity : public GpuTest {};
using Techniques = testing::Types<CylinderArea, CylinderSolidAngle, CylinderProjectedSolidAngle, CylinderLtc>;
TYPED_TEST_SUITE(CylinderParity, Techniques);

TYPED_TEST(CylinderParity, IsAsAccurateAsCpp) {
    for (const Variant variant : variants_for(this->device())) {
        const Verdict verdict =
            judge_twin<TypeParam>(this->device(), shader_of<TypeParam>(variant), random_lights());
        EXPECT_GE(verdict.lights, random_lights());
        expect_parity(verdict);
    }
}

TYPED_TEST(CylinderParity, KeepsTheContractOnHostileLights) {
    for (const Variant variant : variants_for(this->device()))
        EXPECT_EQ(first_violation<TypeParam>(this->device(), shader_of<TypeParam>(variant), hostile_lights()),
                  "");
}

class CylinderMutant : public GpuTest {};

TEST_F(CylinderMutant, HitPointsOnTheMantleInsteadOfTheCapsAreFound) {
    const auto excesses =
        judge_twin<CylinderSolidAnglePair>(device(), shaders::kLidlessCylinder, kMutantLights).excesses;
    const auto count_of = [&](const std::string& begin) {
        return std::count_if(excesses.begin(), excesses.end(),
                             [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
    };
    EXPECT_EQ(count_of("end-on: hit point"), 3) << "all quantiles";
    EXPECT_EQ(count_of("end-on:"), 3) << "all else is right";
    EXPECT_EQ(count_of("close:"), 0) << "its caps are out of sight";
}

} // namespace

} // namespace nusselt::parity
