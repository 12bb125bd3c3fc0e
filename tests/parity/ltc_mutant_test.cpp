// The parity tests must reject a wrong technique for linearly transformed cosines.

#include "gpu_test.h"
#include "lab/parity/technique_parity.h"
#include "mutant.h"

namespace nusselt::parity {

namespace {

class LtcMutant : public GpuTest {};

TEST_F(LtcMutant, MissingClippingIsFound) {
    const auto excesses =
        judge_twin<TechniquePair<hostile::PolygonClippedLtcKindOf<4>>>(
            device(), shader_of<TechniquePair<hostile::PolygonLtcKindOf<4>>>(Variant::split), kMutantLights)
            .excesses;
    const auto count_of = [&](const std::string& begin) {
        return std::count_if(excesses.begin(), excesses.end(),
                             [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
    };
    EXPECT_GT(count_of("crossing the horizon:"), 0);
    EXPECT_EQ(count_of("decentral:"), 0) << "lights above the horizon need no clipping";
}

} // namespace

} // namespace nusselt::parity
