/// All techniques for lobes, lines, cylinders and round lights on hostile lights, in long double.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(PolygonsOnLobes, HostileTest, HostileLongDouble<PolygonOnLobeKinds<4>>,
                               InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonsOnLobes, HostileTest, HostileLongDouble<PolygonOnLobeKinds<8>>,
                               InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(Lines, HostileTest, HostileLongDouble<LineKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(LinesOnLobes, HostileTest, HostileLongDouble<LineOnLobeKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(Cylinders, HostileTest, HostileLongDouble<CylinderKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(CylindersOnLobes, HostileTest, HostileLongDouble<CylinderOnLobeKinds>,
                               InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(Rounds, HostileTest, HostileLongDouble<RoundKinds>, InstanceNames);
INSTANTIATE_TYPED_TEST_SUITE_P(RoundsOnLobes, HostileTest, HostileLongDouble<RoundOnLobeKinds>,
                               InstanceNames);

} // namespace nusselt_test
