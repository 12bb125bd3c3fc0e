/// All techniques for spheres, disks, ellipses and ellipsoids on hostile lights.

#include "common/effort.h"
#include "proof/techniques/fine_round_kinds.h"
#include "sampling/hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(Rounds, HostileTest, HostileTypes<RoundKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(RoundsOnLobes, HostileTest, HostileTypes<RoundOnLobeKinds>, InstanceNames);

namespace {

/// What the suite above leaves out: scalars, which the fuzzer does not have either, and more places.
template <class Test>
class HostileRoundTest : public ::testing::Test {};
template <class...>
struct Both;
template <class... A, class... B>
struct Both<::testing::Types<A...>, ::testing::Types<B...>> {
    using Type = ::testing::Types<A..., B...>;
};
using Scalars = Instances<TestedBy<ContractSuite, RoundKinds, RoundOnLobeKinds>, float>;
using WithManyPlaces = Instances<FineRoundKinds, float, NativeFloat, NativeDouble>;
using RoundTypes = Both<Scalars, WithManyPlaces>::Type;
TYPED_TEST_SUITE(HostileRoundTest, RoundTypes, InstanceNames);

TYPED_TEST(HostileRoundTest, NeverFails) {
    constexpr int kMany = sizeof(typename TypeParam::Scalar) == 4 ? 10'000'000 : 1'000'000;
    expect_contract<TypeParam>(1, at_effort(8000, kMany));
}

TYPED_TEST(HostileRoundTest, NeverFailsWithDenormalsFlushed) {
    const FlushDenormalsToZero flush;
    expect_contract<TypeParam>(2, at_effort(2000, 1'000'000));
}

} // namespace
} // namespace nusselt_test
