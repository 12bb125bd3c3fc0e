// The parity tests must reject a wrong technique for ellipsoids.

#include "lab/parity/technique_parity.h"
#include "platform_test.h"
#include "shaders/uncut_ellipsoid.h"

namespace nusselt::parity {

namespace {

class RoundMutant : public PlatformTest {};

TEST_F(RoundMutant, LightsThatTheHorizonShouldCutAreFound) {
    // So many that each class has a 99 % quantile.
    constexpr int kLights = 8'000;
    const auto wrong = wherever_it_runs({"uncut_ellipsoid", shaders::kUncutEllipsoid});
    for (const auto& [variant, excesses] :
         excesses_of_each(wrong, judge_twins<TechniquePair<hostile::EllipsoidProjectedSolidAngleKind>>(
                                     platform(), wrong, kLights))) {
        SCOPED_TRACE(name_of(variant));
        const auto count_of = [&](const std::string& begin) {
            return std::count_if(excesses.begin(), excesses.end(),
                                 [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
        };
        EXPECT_GT(count_of("crossing the horizon: measure"), 0);
        EXPECT_GT(count_of("1 cm at 2 m, crossing the horizon: measure"), 0);
        EXPECT_EQ(count_of("above:"), 0) << "these lights are whole";
    }
}

} // namespace

} // namespace nusselt::parity
