/// Polygons, projected solid angle, on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(PolygonProjectedSolidAngle, HostileTest,
                               HostileTypes<PolygonProjectedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonBiased, HostileTest, HostileTypes<PolygonBiasedKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonProjectedSolidAngle, HostileTest,
                               HostileTypes<PolygonProjectedSolidAngleKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonBiased, HostileTest, HostileTypes<PolygonBiasedKindOf<8>>);

} // namespace nusselt_test
