// The parity tests must reject a wrong technique for cylinders.

#include "gpu_test.h"
#include "lab/parity/technique_parity.h"
#include "shaders/lidless_cylinder.h"

namespace nusselt::parity {

namespace {

class CylinderMutant : public GpuTest {};

TEST_F(CylinderMutant, HitPointsOnTheLateralSurfaceInsteadOfTheCapsAreFound) {
    // So many that each class has a 99 % quantile, and no more than the quick effort draws.
    constexpr int kLights = 60'000;
    const auto excesses = judge_twin<TechniquePair<hostile::CylinderSolidAngleKind>>(
                              device(), shaders::kLidlessCylinder, kLights)
                              .excesses;
    const auto count_of = [&](const std::string& begin) {
        return std::count_if(excesses.begin(), excesses.end(),
                             [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
    };
    EXPECT_EQ(count_of("end-on: hit point"), 3) << "all quantiles";
    EXPECT_EQ(count_of("end-on:"), 3) << "everything else is correct";
    EXPECT_EQ(count_of("close:"), 0) << "the caps of these lights are out of sight";
}

} // namespace

} // namespace nusselt::parity
