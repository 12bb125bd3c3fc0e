/// The contract of each technique on so many hostile lights that another compiler or processor can try them in seconds.
/// tests/unit has the large numbers.

#include "sampling/hostile_test.h"

namespace nusselt_test {
namespace {

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(HostileTest);

template <class Kind>
class FewHostileLights : public ::testing::Test {};

using Kinds =
    ::testing::Types<PolygonAreaKind, PolygonSolidAngleKind, PolygonClippedSolidAngleKind,
                     PolygonProjectedSolidAngleKind, PolygonProjectedSolidAngleKindOf<8>, LineAreaKind,
                     LineSolidAngleKind, LineClippedSolidAngleKind, LineProjectedSolidAngleKind,
                     PolygonLtcKind, PolygonClippedLtcKind, LineLtcKind, LineClippedLtcKind,
                     CylinderSolidAngleKind, CylinderProjectedSolidAngleKind, CylinderLtcKind>;
TYPED_TEST_SUITE(FewHostileLights, Kinds);

TYPED_TEST(FewHostileLights, PacksNeverFail) {
    expect_contract<Instance<TypeParam, NativeFloat>>(5, 20'000);
    expect_contract<Instance<TypeParam, NativeDouble>>(6, 4000);
}

TYPED_TEST(FewHostileLights, ScalarsNeverFail) {
    expect_contract<Instance<TypeParam, float>>(7, 20'000);
    expect_contract<Instance<TypeParam, long double>>(8, 1000);
}

TYPED_TEST(FewHostileLights, NeverFailWithDenormalsFlushed) {
    const FlushDenormalsToZero flush;
    expect_contract<Instance<TypeParam, NativeFloat>>(9, 20'000);
}

} // namespace
} // namespace nusselt_test
