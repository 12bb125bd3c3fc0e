/// Polygons, area and solid angle techniques, on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(PolygonArea, HostileTest, HostileTypes<PolygonAreaKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonSolidAngle, HostileTest, HostileTypes<PolygonSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonClippedSolidAngle, HostileTest,
                               HostileTypes<PolygonClippedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonArea, HostileTest, HostileTypes<PolygonAreaKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonSolidAngle, HostileTest, HostileTypes<PolygonSolidAngleKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonClippedSolidAngle, HostileTest,
                               HostileTypes<PolygonClippedSolidAngleKindOf<8>>);

} // namespace nusselt_test
