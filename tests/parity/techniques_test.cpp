#include "technique_parity.h"

namespace nusselt::parity {

namespace {

// Named types, for the names of tests.
struct PolygonArea4 : PolygonAreaPair<4> {};
struct PolygonArea8 : PolygonAreaPair<8> {};
struct PolygonSolidAngle4 : PolygonSolidAnglePair<4> {};
struct PolygonSolidAngle8 : PolygonSolidAnglePair<8> {};
struct PolygonClippedSolidAngle4 : PolygonClippedSolidAnglePair<4> {};
struct PolygonClippedSolidAngle8 : PolygonClippedSolidAnglePair<8> {};
struct PolygonProjectedSolidAngle4 : PolygonProjectedSolidAnglePair<4> {};
struct PolygonProjectedSolidAngle8 : PolygonProjectedSolidAnglePair<8> {};
struct PolygonProjectedSolidAngleBiased4 : PolygonProjectedSolidAngleBiasedPair<4> {};
struct PolygonProjectedSolidAngleBiased8 : PolygonProjectedSolidAngleBiasedPair<8> {};
struct LineArea : TechniquePair<proof::LineAreaTraits, hostile::LineAreaKind> {};
struct LineSolidAngle : TechniquePair<proof::LineSolidAngleTraits, hostile::LineSolidAngleKind> {};
struct LineClippedSolidAngle
    : TechniquePair<proof::LineClippedSolidAngleTraits, hostile::LineClippedSolidAngleKind> {};
struct LineProjectedSolidAngle
    : TechniquePair<proof::LineProjectedSolidAngleTraits, hostile::LineProjectedSolidAngleKind> {};

template <class Pair>
class TechniqueParity : public GpuTest {};
using Techniques = testing::Types<PolygonArea4, PolygonArea8, PolygonSolidAngle4, PolygonSolidAngle8,
                                  PolygonClippedSolidAngle4, PolygonClippedSolidAngle8,
                                  PolygonProjectedSolidAngle4, PolygonProjectedSolidAngle8,
                                  PolygonProjectedSolidAngleBiased4, PolygonProjectedSolidAngleBiased8,
                                  LineArea, LineSolidAngle, LineClippedSolidAngle, LineProjectedSolidAngle>;
TYPED_TEST_SUITE(TechniqueParity, Techniques);

TYPED_TEST(TechniqueParity, IsAsAccurateAsCpp) {
    const int count = random_lights_of<TypeParam>();
    for (const Variant variant : variants_for(this->device())) {
        const Verdict verdict = judge_twin<TypeParam>(this->device(), shader_of<TypeParam>(variant), count);
        EXPECT_GE(verdict.lights, count);
        expect_parity(verdict);
    }
}

TYPED_TEST(TechniqueParity, KeepsTheContractOnHostileLights) {
    for (const Variant variant : variants_for(this->device()))
        EXPECT_EQ(first_violation<TypeParam>(this->device(), shader_of<TypeParam>(variant), hostile_lights()),
                  "");
}

} // namespace

} // namespace nusselt::parity
