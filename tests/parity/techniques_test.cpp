#include "technique_parity.h"

namespace nusselt::parity {

namespace {

template <class Pair>
class TechniqueParity : public GpuTest {};
using Techniques = PairsOf<hostile::KindsWithBounds<4, 8>>;
TYPED_TEST_SUITE(TechniqueParity, Techniques, PairNames);

TYPED_TEST(TechniqueParity, IsAsAccurateAsCpp) {
    const int count = random_lights_of<TypeParam>();
    const auto shaders = shaders_for<TypeParam>(this->device());
    for (const Verdict& verdict : judge_twins<TypeParam>(this->device(), shaders, count)) {
        EXPECT_GE(verdict.lights, count);
        expect_parity(verdict);
    }
}

TYPED_TEST(TechniqueParity, KeepsTheContractOnHostileLights) {
    for (const auto shader : shaders_for<TypeParam>(this->device()))
        EXPECT_EQ(first_violation<TypeParam>(this->device(), shader, hostile_lights()), "");
}

} // namespace

} // namespace nusselt::parity
