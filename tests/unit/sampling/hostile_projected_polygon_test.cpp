/// Polygons, projected solid angle, on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(PolygonProjectedSolidAngle, HostileTest,
                               HostileTypes<PolygonProjectedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonBiased, HostileTest, HostileTypes<PolygonBiasedKind>);

} // namespace nusselt_test
