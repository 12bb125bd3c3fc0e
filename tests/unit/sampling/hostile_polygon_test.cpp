/// All techniques for polygons with few vertices on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

using FourVertices = HostileTypes<PolygonKinds<4>, RectangleKinds>;
INSTANTIATE_TYPED_TEST_SUITE_P(Polygons, HostileTest, FourVertices, InstanceNames);

} // namespace nusselt_test
