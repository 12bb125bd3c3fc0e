/// Polygons, in long double, which no instruction set changes.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(ExactPolygonArea, HostileTest, HostileLongDouble<PolygonAreaKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactPolygonSolidAngle, HostileTest, HostileLongDouble<PolygonSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactPolygonClippedSolidAngle, HostileTest,
                               HostileLongDouble<PolygonClippedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactOctagonArea, HostileTest, HostileLongDouble<PolygonAreaKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactOctagonSolidAngle, HostileTest,
                               HostileLongDouble<PolygonSolidAngleKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactOctagonClippedSolidAngle, HostileTest,
                               HostileLongDouble<PolygonClippedSolidAngleKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactPolygonProjectedSolidAngle, HostileTest,
                               HostileLongDouble<PolygonProjectedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactPolygonBiased, HostileTest, HostileLongDouble<PolygonBiasedKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactOctagonProjectedSolidAngle, HostileTest,
                               HostileLongDouble<PolygonProjectedSolidAngleKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactOctagonBiased, HostileTest, HostileLongDouble<PolygonBiasedKindOf<8>>);

} // namespace nusselt_test
