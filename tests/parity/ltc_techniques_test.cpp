// Techniques for linearly transformed cosines, and wrong ones.

#include "ltc_parity.h"

namespace nusselt::parity {

namespace {

// Named types, for the names of tests.
struct PolygonLtc4 : PolygonLtcPair<4> {};
struct PolygonLtc8 : PolygonLtcPair<8> {};
struct PolygonClippedLtc4 : PolygonClippedLtcPair<4> {};
struct PolygonClippedLtc7 : PolygonClippedLtcPair<7> {};
struct LineLtc : LineLtcPair {};
struct LineClippedLtc : LineClippedLtcPair {};

template <class Pair>
class LtcParity : public GpuTest {};
using Techniques =
    testing::Types<PolygonLtc4, PolygonLtc8, PolygonClippedLtc4, PolygonClippedLtc7, LineLtc, LineClippedLtc>;
TYPED_TEST_SUITE(LtcParity, Techniques);

TYPED_TEST(LtcParity, IsAsAccurateAsCpp) {
    const int count = random_lights_of<TypeParam>();
    for (const Variant variant : variants_for(this->device())) {
        const Verdict verdict = judge_twin<TypeParam>(this->device(), shader_of<TypeParam>(variant), count);
        EXPECT_GE(verdict.lights, count);
        expect_parity(verdict);
    }
}

TYPED_TEST(LtcParity, KeepsTheContractOnHostileLights) {
    for (const Variant variant : variants_for(this->device()))
        EXPECT_EQ(first_violation<TypeParam>(this->device(), shader_of<TypeParam>(variant), hostile_lights()),
                  "");
}

class LtcMutant : public GpuTest {};

TEST_F(LtcMutant, MissingClippingIsFound) {
    const auto excesses = judge_twin<PolygonClippedLtcPair<4>>(
                              device(), shader_of<PolygonLtcPair<4>>(Variant::split), kMutantLights)
                              .excesses;
    const auto count_of = [&](const std::string& begin) {
        return std::count_if(excesses.begin(), excesses.end(),
                             [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
    };
    EXPECT_GT(count_of("crossing the horizon:"), 0);
    EXPECT_EQ(count_of("decentral:"), 0) << "above the horizon nothing is missing";
}

} // namespace

} // namespace nusselt::parity
