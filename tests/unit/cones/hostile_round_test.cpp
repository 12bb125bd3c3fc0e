/// All techniques for spheres, disks, ellipses and ellipsoids on hostile lights.

#include "common/effort.h"
#include "proof/techniques/fine_round_kinds.h"
#include "sampling/hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(Rounds, HostileTest, HostileTypes<RoundKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(RoundsOnLobes, HostileTest, HostileTypes<RoundOnLobeKinds>, InstanceNames);

namespace {

template <class Test>
class HostileFineTest : public ::testing::Test {};
using FineTypes = Instances<FineRoundKinds, float, NativeFloat, NativeDouble>;
TYPED_TEST_SUITE(HostileFineTest, FineTypes, InstanceNames);

TYPED_TEST(HostileFineTest, NeverFails) {
    constexpr int kMany = sizeof(typename TypeParam::Scalar) == 4 ? 10'000'000 : 1'000'000;
    expect_contract<TypeParam>(1, at_effort(8000, kMany));
}

TYPED_TEST(HostileFineTest, NeverFailsWithDenormalsFlushed) {
    const FlushDenormalsToZero flush;
    expect_contract<TypeParam>(2, at_effort(2000, 1'000'000));
}

} // namespace
} // namespace nusselt_test
