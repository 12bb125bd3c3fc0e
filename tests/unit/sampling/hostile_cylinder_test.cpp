/// All techniques for cylinders on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(Cylinders, HostileTest, HostileTypes<CylinderKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(CylindersOnLobes, HostileTest, HostileTypes<CylinderOnLobeKinds>,
                               InstanceNames);

} // namespace nusselt_test
