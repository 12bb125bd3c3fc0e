// The parity tests must reject a wrong technique for cylinders.

#include "lab/parity/technique_parity.h"
#include "platform_test.h"
#include "shaders/lidless_cylinder.h"

namespace nusselt::parity {

namespace {

class CylinderMutant : public PlatformTest {};

TEST_F(CylinderMutant, HitPointsOnTheLateralSurfaceInsteadOfTheCapsAreFound) {
    // So many that each class has a 99 % quantile, and no more than the quick effort draws.
    constexpr int kLights = 60'000;
    const auto wrong = wherever_it_runs({"lidless_cylinder", shaders::kLidlessCylinder});
    for (const auto& [variant, excesses] : excesses_of_each(
             wrong,
             judge_twins<TechniquePair<hostile::CylinderSolidAngleKind>>(platform(), wrong, kLights))) {
        SCOPED_TRACE(name_of(variant));
        const auto count_of = [&](const std::string& begin) {
            return std::count_if(excesses.begin(), excesses.end(),
                                 [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
        };
        EXPECT_EQ(count_of("end-on: hit point"), 3) << "all quantiles";
        EXPECT_EQ(count_of("end-on:"), 3) << "everything else is correct";
        EXPECT_EQ(count_of("close:"), 0) << "the caps of these lights are out of sight";
    }
}

} // namespace

} // namespace nusselt::parity
