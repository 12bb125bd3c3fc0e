/// Cylinders, all techniques, on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(CylinderSolidAngle, HostileTest, HostileTypes<CylinderSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(CylinderProjectedSolidAngle, HostileTest,
                               HostileTypes<CylinderProjectedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(CylinderLtc, HostileTest, HostileTypes<CylinderLtcKind>);

} // namespace nusselt_test
