// The parity tests must reject a wrong technique for linearly transformed cosines.

#include "lab/parity/technique_parity.h"
#include "mutant.h"
#include "platform_test.h"

namespace nusselt::parity {

namespace {

class LtcMutant : public PlatformTest {};

TEST_F(LtcMutant, MissingClippingIsFound) {
    const auto wrong =
        wherever_it_runs(shader_of<TechniquePair<hostile::PolygonLtcKindOf<4>>>(Variant::split).shader);
    for (const auto& [variant, excesses] :
         excesses_of_each(wrong, judge_twins<TechniquePair<hostile::PolygonClippedLtcKindOf<4>>>(
                                     platform(), wrong, kMutantLights))) {
        SCOPED_TRACE(name_of(variant));
        const auto count_of = [&](const std::string& begin) {
            return std::count_if(excesses.begin(), excesses.end(),
                                 [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
        };
        EXPECT_GT(count_of("crossing the horizon:"), 0);
        EXPECT_EQ(count_of("decentral:"), 0) << "lights above the horizon need no clipping";
    }
}

} // namespace

} // namespace nusselt::parity
