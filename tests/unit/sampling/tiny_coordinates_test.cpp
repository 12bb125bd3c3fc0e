/// Tests of vertices so close to the point or to the horizon that squares and products of their coordinates
/// underflow.

#include <gtest/gtest.h>

#include "contract.h"
#include "flush_denormals.h"

namespace nusselt_test {
namespace {

using Vec = nusselt::Vec3<float>;
using Vec2 = nusselt::Vec2<float>;

template <int N, int Count>
nusselt::ConvexPolygon<float, N> polygon(const Vec (&vertices)[Count]) {
    return nusselt::make_polygon<N>(vertices, Count);
}

template <class Kind>
void expect_contract(const typename Kind::template Light<float>& light,
                     const typename Kind::template Random<float>& u) {
    EXPECT_STREQ((violation<Kind, float>(light, outputs_of<Kind, float>(light, u))), nullptr);
}

/// The direction to a vertex at a denormal distance overflowed, and with it wi, although the density was positive.
TEST(TinyCoordinatesTest, SolidAngleWithAVertexAtADenormalDistance) {
    const auto first = polygon<4>({{0, 0, 0x1p-148f}, {2, 0, -1}, {2, 2, -1}});
    const auto last = polygon<4>({{-0x1.7b2e4p+9f, -0x1.e55658p+9f, 0x1.4a5bb6p+10f},
                                  {-0x1.fb8902p+9f, -0x1.44d028p+10f, 0x1.ba2f76p+10f},
                                  {-0x1.4f48e8p+8f, -0x1.ad26e4p+8f, 0x1.241cf6p+9f},
                                  {-0x1.58018p-130f, -0x1.26p-142f, 0}});
    for (const auto& light : {first, last}) {
        expect_contract<PolygonSolidAngleKind>(light, Vec2{0.5f, 0.5f});
        expect_contract<PolygonClippedSolidAngleKind>(light, Vec2{0.5f, 0.5f});
    }
}

/// The plane contains the point, whatever the distant vertices suggest.
TEST(TinyCoordinatesTest, SolidAngleWithAVertexAtThePoint) {
    const auto light = polygon<4>({{-0x1.0e11ep+11f, 0x1.39d8c2p+9f, -0x1.409dap+11f},
                                   {0x1.744fa4p+12f, -0x1.a9e4a8p+10f, 0x1.bb6376p+12f},
                                   {0, 0, 0}});
    EXPECT_EQ((nusselt::PolygonClippedSolidAngle<float, 4>(light).measure()), 0);
    EXPECT_EQ((nusselt::PolygonSolidAngle<float, 4>(light).measure()), 0);
}

/// The part above the horizon is as thin as the smallest number, but it had the measure of a large light.
TEST(TinyCoordinatesTest, ProjectedSolidAngleOfAWallThatEndsAtTheHorizon) {
    const auto light = polygon<4>({{-0x1.c3d272p+9f, -0x1.f92326p+8f, 0x1.4p-146f},
                                   {0x1.9716b8p+9f, -0x1.fd2cacp+9f, 0x1.4p-146f},
                                   {0x1.9716b8p+9f, -0x1.fd2cacp+9f, -0x1.f6eac4p+7f},
                                   {-0x1.c3d272p+9f, -0x1.f92326p+8f, -0x1.f6eac4p+7f}});
    const nusselt::PolygonProjectedSolidAngle<float, 4> technique(light);
    EXPECT_LT(technique.measure(), 1e-30f);
    expect_contract<PolygonProjectedSolidAngleKind>(light, Vec2{0x1.ff89fap-1f, 0x1.dd65fcp-4f});
}
TEST(TinyCoordinatesTest, ProjectedSolidAngleOfAWallThatEndsAtTheHorizonWithDenormalsFlushed) {
    const FlushDenormalsToZero flush;
    const auto light = polygon<4>({{-1, 1, 0x1.4b8abep-125f},
                                   {-1, 2, 0x1.4b8abep-125f},
                                   {-1, 2, -0x1.299ee8p+4f},
                                   {-1, 1, -0x1.299ee8p+4f}});
    const nusselt::PolygonProjectedSolidAngle<float, 4> technique(light);
    EXPECT_LT(technique.measure(), 1e-30f);
    expect_contract<PolygonProjectedSolidAngleKind>(light, Vec2{0x1.fffffep-1f, 0x1.db4bap-3f});
}

/// A strip above the horizon, thinner than rounding, was sampled in the direction of the zenith.
TEST(TinyCoordinatesTest, ProjectedSolidAngleOfAThinStripAboveTheHorizon) {
    const auto light = polygon<4>({{-0x1.7e23cep-2f, 0x1.35e2a2p-5f, -0x1.2bc91ap-2f},
                                   {-0x1.a325bap-2f, 0x1.7a29bcp-4f, 0},
                                   {0x1.5d9e34p-3f, -0x1.d205a8p-4f, 0},
                                   {0x1.5d9e34p-3f, -0x1.d205a8p-4f, 0x1.a2e7aep-54f}});
    expect_contract<PolygonProjectedSolidAngleKind>(light, Vec2{0x1.ece082p-2f, 0x1.ccfa8ep-10f});
}

/// The weights of the ends lost their digits, so wi was too short.
TEST(TinyCoordinatesTest, SolidAngleOfALineThatEndsAtTheHorizon) {
    expect_contract<LineClippedSolidAngleKind>(nusselt::make_line(Vec{1, 0, 0x1p-128f}, Vec{2, 0, -1}),
                                               0.25f);
    expect_contract<LineClippedSolidAngleKind>(
        nusselt::make_line(Vec{-0x1.569736p-2f, -0x1.73bca2p-6f, 0x1.a5f6p-131f},
                           Vec{-0x1.8ac402p-2f, -0x1.ca3c32p-5f, -0x1.d98a3p-1f}),
        0x1.ed65a4p-3f);
}

/// The density became infinite on its way to a number in range.
TEST(TinyCoordinatesTest, SolidAngleOfALineOfDenormalLength) {
    for (float length = 0x1p-126f; length > 0; length /= 2) {
        for (float distance = 1; distance > 0x1p-100f; distance /= 2)
            expect_contract<LineSolidAngleKind>({{0, distance, 0}, {0, 0, 1}, length}, 0.5f);
    }
}

/// The density did not follow the measure where the reciprocal of its integral was out of range.
TEST(TinyCoordinatesTest, ProjectedSolidAngleOfALineOfDenormalLength) {
    for (float length = 0x1p-110f; length > 0; length /= 2) {
        for (float scale = 1; scale > 0x1p-100f; scale /= 2) {
            const nusselt::LineProjectedSolidAngle<float> technique({{0, scale, scale}, {1, 0, 0}, length});
            if (technique.measure() == 0) continue;
            const auto s = technique.sample(0.5f);
            EXPECT_NEAR(s.pdf * technique.measure() / s.wi.z, 1, 1e-5) << length << ' ' << scale;
        }
    }
}

/// Where the density overflowed, sample() returned the largest number and pdf() 0.
TEST(TinyCoordinatesTest, AreaOfLightsWhoseDensityOverflows) {
    for (float length = 0x1p-120f; length > 0; length /= 2) {
        for (float x = 0; x < 4; x += 0.25f) {
            expect_contract<LineAreaKind>({{x, 1, 1}, {1, 0, 0}, length}, 0.5f);
            expect_contract<LineAreaKind>({{x, 1, 1}, {0.6f, 0.8f, 0}, length}, 0.5f);
        }
        EXPECT_GT(nusselt::LineArea<float>({{0, 1, 1}, {1, 0, 0}, length}).sample(0.5f).pdf, 0);
    }
}

} // namespace
} // namespace nusselt_test
