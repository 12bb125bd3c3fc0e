/// The contract of each technique on so many hostile lights that another compiler or processor can try them in seconds.
/// tests/unit has the large numbers.

#include "sampling/hostile_test.h"

namespace nusselt_test {
namespace {

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(HostileTest);

template <class Test>
class FewHostileLights : public ::testing::Test {};

using Types = Instances<TestedBy<ContractSuite, KindsWithBounds<4, 8>>, float>;
TYPED_TEST_SUITE(FewHostileLights, Types, InstanceNames);

TYPED_TEST(FewHostileLights, PacksNeverFail) {
    expect_contract<Instance<typename TypeParam::Kind, NativeFloat>>(5, 20'000);
    expect_contract<Instance<typename TypeParam::Kind, NativeDouble>>(6, 4000);
}

TYPED_TEST(FewHostileLights, ScalarsNeverFail) {
    expect_contract<Instance<typename TypeParam::Kind, float>>(7, 20'000);
    expect_contract<Instance<typename TypeParam::Kind, long double>>(8, 1000);
}

TYPED_TEST(FewHostileLights, NeverFailWithDenormalsFlushed) {
    const FlushDenormalsToZero flush;
    expect_contract<Instance<typename TypeParam::Kind, NativeFloat>>(9, 20'000);
}

} // namespace
} // namespace nusselt_test
