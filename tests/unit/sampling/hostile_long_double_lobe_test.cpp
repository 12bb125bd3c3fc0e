/// Lobes, lines and cylinders, in long double, which no instruction set changes.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(ExactPolygonLtc, HostileTest, HostileLongDouble<PolygonLtcKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactPolygonClippedLtc, HostileTest, HostileLongDouble<PolygonClippedLtcKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactOctagonLtc, HostileTest, HostileLongDouble<PolygonLtcKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactLineLtc, HostileTest, HostileLongDouble<LineLtcKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactLineClippedLtc, HostileTest, HostileLongDouble<LineClippedLtcKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactLineArea, HostileTest, HostileLongDouble<LineAreaKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactLineSolidAngle, HostileTest, HostileLongDouble<LineSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactLineClippedSolidAngle, HostileTest,
                               HostileLongDouble<LineClippedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactLineProjectedSolidAngle, HostileTest,
                               HostileLongDouble<LineProjectedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactCylinderSolidAngle, HostileTest,
                               HostileLongDouble<CylinderSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactCylinderProjectedSolidAngle, HostileTest,
                               HostileLongDouble<CylinderProjectedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactCylinderLtc, HostileTest, HostileLongDouble<CylinderLtcKind>);

} // namespace nusselt_test
