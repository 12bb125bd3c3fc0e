/// All techniques for polygons and lobes on hostile lights.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(PolygonsOnLobes, HostileTest, HostileTypes<PolygonOnLobeKinds<4>>,
                               InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonsOnLobes, HostileTest, HostileTypes<PolygonOnLobeKinds<8>>,
                               InstanceNames);

} // namespace nusselt_test
