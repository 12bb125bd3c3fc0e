/// All techniques for spheres, disks, ellipses and ellipsoids on hostile lights.

#include "sampling/hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(Rounds, HostileTest, HostileTypes<RoundKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(RoundsOnLobes, HostileTest, HostileTypes<RoundOnLobeKinds>, InstanceNames);

} // namespace nusselt_test
