/// Linearly transformed cosines on hostile lights and lobes.

#include "hostile_test.h"

namespace nusselt_test {

INSTANTIATE_TYPED_TEST_SUITE_P(PolygonLtc, HostileTest, HostileTypes<PolygonLtcKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonClippedLtc, HostileTest, HostileTypes<PolygonClippedLtcKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonLtc, HostileTest, HostileTypes<PolygonLtcKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineLtc, HostileTest, HostileTypes<LineLtcKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineClippedLtc, HostileTest, HostileTypes<LineClippedLtcKind>);

} // namespace nusselt_test
