/// All techniques for polygons on hostile lights, in long double.

#include "hostile_test.h"

namespace nusselt_test {

using FourVertices = HostileLongDouble<PolygonKinds<4>, RectangleKinds>;
INSTANTIATE_TYPED_TEST_SUITE_P(Polygons, HostileTest, FourVertices, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(Octagons, HostileTest, HostileLongDouble<PolygonKinds<8>>, InstanceNames);

} // namespace nusselt_test
