/// All techniques for polygons with many vertices on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(Octagons, HostileTest, HostileTypes<PolygonKinds<8>>, InstanceNames);

} // namespace nusselt_test
