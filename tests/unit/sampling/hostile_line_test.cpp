/// All techniques for lines on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(Lines, HostileTest, HostileTypes<LineKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(LinesOnLobes, HostileTest, HostileTypes<LineOnLobeKinds>, InstanceNames);

} // namespace nusselt_test
