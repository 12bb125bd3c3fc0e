/// Lines, all techniques, on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(LineArea, HostileTest, HostileTypes<LineAreaKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineSolidAngle, HostileTest, HostileTypes<LineSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineClippedSolidAngle, HostileTest, HostileTypes<LineClippedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineProjectedSolidAngle, HostileTest,
                               HostileTypes<LineProjectedSolidAngleKind>);

} // namespace nusselt_test
