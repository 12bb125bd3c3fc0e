/// Inputs that once broke a technique.

#include <cstring>
#include <initializer_list>
#include <iterator>
#include <new>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "contract.h"
#include "lights.h"

namespace nusselt_test {
namespace {

using Quad = nusselt::ConvexPolygon<float, 4>;
using Line = nusselt::LineSegment<float>;

Quad quad(const nusselt::Vec3<float>& a, const nusselt::Vec3<float>& b, const nusselt::Vec3<float>& c,
          const nusselt::Vec3<float>& d) {
    const nusselt::Vec3<float> vertices[] = {a, b, c, d};
    return nusselt::make_polygon<4>(vertices, 4);
}

template <class Kind, class Real = float>
void expect_contract(const typename Kind::template Light<Real>& light,
                     const typename Kind::template Random<Real>& u) {
    EXPECT_STREQ((violation<Kind, Real>(light, outputs_of<Kind, Real>(light, u))), nullptr);
}

/// The end on the horizon is closer to the point than the rounding error of the length. Its coordinate along the line
/// and its height must agree.
TEST(RegressionTest, LineEndsOnTheHorizonNextToThePoint) {
    const Line falling{{-0x9.1afep-4f, 0xf.4f73p-6f, 0xc.be5c2p-4f},
                       {0x9.092d2p-4f, -0xf.317e1p-6f, -0xc.a56cep-4f},
                       0x8.0fc61p-3f};
    expect_contract<LineClippedSolidAngleKind>(falling, 0xe.ee675p-5f);
    expect_contract<LineProjectedSolidAngleKind>(falling, 0xe.ee675p-5f);
    const Line ending{{0xd.682f9p-4f, -0x8.207edp-4f, 0xc.c72ddp-6f},
                      {-0xd.68315p-4f, 0x8.207fep-4f, -0xc.c72f8p-6f},
                      0xf.fffdep-4f};
    expect_contract<LineClippedSolidAngleKind>(ending, 0x8.7734p-4f);
    expect_contract<LineProjectedSolidAngleKind>(ending, 0x8.7734p-4f);
}

/// Rounding turned the directions to ends next to the horizon below it.
TEST(RegressionTest, LineThatDipsBelowTheHorizonIsSampledAboveIt) {
    const auto expect_above = [](const auto& start, const auto& end, auto u) {
        using Real = decltype(u);
        const nusselt::LineSegment<Real> light = nusselt::make_line(start, end);
        expect_contract<LineClippedSolidAngleKind, Real>(light, u);
        EXPECT_GE(nusselt::LineClippedSolidAngle<Real>(light).sample(u).wi.z, 0);
    };
    using Float3 = nusselt::Vec3<float>;
    expect_above(Float3{9.30984879f, 10.7484589f, -0.27369687f}, Float3{2.2934885f, 11.2559195f, 6.13668823f},
                 0.0f);
    expect_above(Float3{-165.985092f, 759.862427f, 7.84876941e-10f}, Float3{0, 0, -341.590363f}, 0.99999994f);
    // Some 1e-17 and 1e-16 below it.
    using Double3 = nusselt::Vec3<double>;
    expect_above(Double3{0.13322549278580736, 0.91956543366479615, -0.00012728463884091167},
                 Double3{-0.32702894597440407, -0.28041254868413101, 0.39008675965661305}, 0.0);
    expect_above(Double3{1.5687714194960134, 1.3304330570687801, -0.21789756778839836},
                 Double3{0.20972649888283695, -0.12202478433976012, 1.6588432342540258}, 0.0);
}

/// The sector spans half a turn, so the directions of its ends add up to zero.
TEST(RegressionTest, SectorOfHalfATurn) {
    expect_contract<PolygonProjectedSolidAngleKind>(quad({0xe.21d2ap+15f, 0xa.3abf9p+15f, -0x9.80d34p+16f},
                                                         {0xb.0a067p+16f, 0xe.28c64p+14f, 0xb.50a8fp+15f},
                                                         {-0x8.17cbcp+16f, -0xa.af1c4p+15f, 0x8.81c9ap+16f},
                                                         {-0xb.a1926p+16f, -0x8.789dap+15f, -0xe.854c7p+14f}),
                                                    nusselt::Vec2<float>{0xd.73aap-4f, 0xf.1ca35p-4f});
}

/// A vertex is at the point, so the plane of the polygon contains the point, whatever the other vertices suggest.
TEST(RegressionTest, PointOnAVertexFarFromTheOthers) {
    const Quad light = quad({-0xc.3dea9p+30f, -0xa.14025p+30f, 0xa.732c1p+29f},
                            {-0x9.7fa8bp+30f, -0xa.85f44p+31f, 0xd.c92a4p+25f},
                            {0xd.b455p+29f, -0xe.53e69p+30f, -0x8.6514cp+30f}, {0, 0, 0});
    const nusselt::Vec2<float> u{0xf.fffffp-4f, 0xc.1e453p-8f};
    expect_contract<PolygonProjectedSolidAngleKind>(light, u);
    EXPECT_EQ((nusselt::PolygonProjectedSolidAngle<float, 4>(light).measure()), 0);
}

/// An edge passes the point within rounding, so the angle between its clipped ends is noise.
TEST(RegressionTest, EdgeThroughThePointClippedAtTheHorizon) {
    expect_contract<PolygonProjectedSolidAngleKind>(quad({0x9.184c8p-8f, 0xa.58113p-8f, 0xb.6a62cp-6f},
                                                         {0xf.38f41p-12f, 0x9.cde45p-12f, -0xd.e43c1p-14f},
                                                         {-0xc.b3cedp-8f, -0x8.2e605p-8f, 0xb.977efp-10f},
                                                         {-0xc.5865ep-14f, 0x9.3cdep-9f, 0xc.a0e5bp-6f}),
                                                    nusselt::Vec2<float>{0xc.abed2p-4f, 0xe.36126p-4f});
}

/// The area of the sector was rounding noise, and the initialisation of the iteration left the sector.
TEST(RegressionTest, SliverThinnerThanRounding) {
    const Quad light =
        quad({-0xe.590eep-4f, 0x8.0d959p-5f, 0xe.aef41p-5f}, {-0xd.74009p-4f, 0x8.0dc7bp-5f, 0xf.4295cp-5f},
             {-0xd.e38dap-4f, 0x8.0daf4p-5f, 0xe.fab02p-5f}, {-0xd.7bf56p-4f, 0x8.0dc5fp-5f, 0xf.3d75p-5f});
    expect_contract<PolygonProjectedSolidAngleKind>(light, nusselt::Vec2<float>{0, 0x9.c6edap-4f});
}

/// For a light seen edge-on, the distance to its plane along a direction has no correct digits.
TEST(RegressionTest, HitPointOnALightSeenEdgeOn) {
    expect_contract<PolygonProjectedSolidAngleKind>(quad({0, 0, 0},
                                                         {-0xc.d99cbp+5f, -0xd.13fb2p+1f, 0xb.a516ep+5f},
                                                         {-0xb.15c2dp+8f, -0xb.4ab92p+4f, 0xa.0b8ddp+8f},
                                                         {-0xb.15c2dp+8f, -0xb.4ab92p+4f, 0xa.0b8ddp+8f}),
                                                    nusselt::Vec2<float>{0xb.0b609p-8f, 0xf.fc39bp-4f});
}

/// Two vertices are in almost opposite directions. Cosines lost the sum of these directions, and with it the sample.
TEST(RegressionTest, SolidAngleOfAWallNextToThePoint) {
    expect_contract<PolygonSolidAngleKind>(
        quad({0xa.e7792p-6f, 0x8.49158p-8f, -0xc.98687p+3f}, {0xa.e8f57p-6f, 0x8.4a368p-8f, -0xc.98687p+3f},
             {0xa.e8f57p-6f, 0x8.4a368p-8f, 0x8.acfe7p+5f}, {0xa.e7792p-6f, 0x8.49158p-8f, 0x8.acfe7p+5f}),
        nusselt::Vec2<float>{0xa.70627p-6f, 0xf.fa276p-4f});
    expect_contract<PolygonSolidAngleKind>(quad({0x9.f714p+13f, -0xa.547cfp+12f, 0x9.b5b84p-3f},
                                                {-0xd.cf154p+12f, 0xe.51d0dp+11f, 0x9.b5b84p-3f},
                                                {-0xd.cf154p+12f, 0xe.51d0dp+11f, 0xd.a3e21p-4f},
                                                {0x9.f714p+13f, -0xa.547cfp+12f, 0xd.a3e21p-4f}),
                                           nusselt::Vec2<float>{0xe.8318ep-4f, 0xf.fffffp-4f});
}

/// Rounding may move the last direction of a light beyond the light. With unused vertex slots, the inversion then
/// found no triangle or sector and lost the second random number.
TEST(RegressionTest, InversionAtTheLastDirection) {
    const auto light = make_light<float>(PolygonCase{"", {{0.3, -1, 0.5}, {1.5, -0.2, 0.7}, {0.6, 1, 1.2}}});
    const nusselt::Vec2<float> u{kLargestBelowOne<float>, 0.5f};
    const auto second = [&](const auto& technique) { return technique.invert(technique.sample(u).wi).y; };
    EXPECT_NEAR(second(nusselt::PolygonArea<float, 8>(nusselt::make_polygon<8>(light.vertex, 4))), 0.5f,
                1e-5f);
    EXPECT_NEAR(second(nusselt::PolygonSolidAngle<float, 8>(nusselt::make_polygon<8>(light.vertex, 4))), 0.5f,
                1e-5f);
}

/// The same with a vertex at the zenith, where the first direction was in no sector.
TEST(RegressionTest, InversionAtTheFirstDirectionWithTheZenithOnAVertex) {
    const auto light = make_light<float>(PolygonCase{"", {{0, 0, 1}, {1, 0.2, 1}, {0.8, 1.1, 1}}});
    const nusselt::PolygonProjectedSolidAngle<float, 4> technique(light);
    for (const float y : {1e-3f, 0.71f, 0.9f}) {
        EXPECT_NEAR(technique.invert(technique.sample({0, y}).wi).y, y, 1e-5f);
    }
}

/// For lights whose plane contains the point, clipping created vertices off that plane, so the light filled up to
/// half a sphere.
TEST(RegressionTest, ClippedSolidAngleFromThePlaneOfTheLight) {
    const Quad light = quad({0, 4, -27}, {-26, -2, 13}, {0, -4, 27}, {26, 2, -13});
    EXPECT_EQ((nusselt::PolygonClippedSolidAngle<float, 4>(light).measure()), 0);
    const nusselt::Vec3<double> vertices[] = {{5, 4, -27}, {-21, -2, 13}, {-5, -4, 27}, {21, 2, -13}};
    const auto in_double = nusselt::make_polygon<4>(vertices, 4);
    EXPECT_EQ((nusselt::PolygonClippedSolidAngle<double, 4>(in_double).measure()), 0);
}

/// Rounding moved samples below the horizon, and hit points away from their directions.
TEST(RegressionTest, ClippedSolidAngleFromCloseBy) {
    const Quad light =
        quad({-0x1.a054cp-3f, -0x1.4b4ep-2f, 0x1.2dad4p-1f}, {-0x1.7e2a6p-2f, -0x1.6aa7p-1f, -0x1.44a58p-2f},
             {0x1.3f568p-4f, 0x1.42c8p-4f, -0x1.7952cp-1f}, {0x1.fbab4p-3f, 0x1.dab2p-2f, 0x1.5ab5p-3f});
    const nusselt::PolygonClippedSolidAngle<float, 4> technique(light);
    for (const float x : {0.01f, 0x1.420254p-3f, 0.5f, 0.99f}) {
        for (const float y : {0.0f, 0.3f, 0x1.fffffep-1f}) {
            const auto [wi, pdf, p] = technique.sample({x, y});
            EXPECT_GE(wi.z, 0) << x << ", " << y;
            const auto towards = normalize(p);
            EXPECT_LE(length(towards - wi), 1e-6f) << x << ", " << y;
        }
    }
}

/// The ends lie on both sides of the closest point, where the extent of the light once came from their sines alone.
TEST(RegressionTest, LineBelowTheHorizonIsDarkAroundTheClosestPoint) {
    const Line below = nusselt::make_line<float>({-1, 0.3f, -0.5f}, {1, 0.3f, -0.5f});
    const nusselt::LineClippedSolidAngle<float> solid_angle(below);
    EXPECT_EQ(solid_angle.measure(), 0);
    EXPECT_EQ(solid_angle.sample(0.3f).pdf, 0);
    expect_contract<LineClippedSolidAngleKind>(below, 0.3f);
    const nusselt::LineProjectedSolidAngle<float> projected(below);
    EXPECT_EQ(projected.measure(), 0);
    EXPECT_EQ(projected.sample(0.3f).pdf, 0);
    expect_contract<LineProjectedSolidAngleKind>(below, 0.3f);
}

/// Vertices whose squared distances leave the range of float once had no solid angle.
TEST(RegressionTest, PolygonThatReachesVeryFarKeepsItsSolidAngle) {
    const nusselt::Vec3<float> vertices[] = {{0, 0, 1}, {2e19f, 0, 1}, {2e19f, 0.5f, 1}};
    const auto polygon = nusselt::make_polygon<3>(vertices, 3);
    const nusselt::PolygonSolidAngle<float, 3> technique(polygon);
    EXPECT_NEAR(technique.measure() / 2.5e-20f, 1, 1e-5f);
}

/// A line that passed through the point except for rounding had a measure of up to 1e11.
TEST(RegressionTest, LineThroughThePointIsDark) {
    const nusselt::Vec3<float> a{0.3f, -0.7f, 0.4f};
    for (const float k : {2.0f, -1.0f, 0.0f}) {
        EXPECT_EQ(nusselt::LineProjectedSolidAngle<float>(nusselt::make_line(a, k * a)).measure(), 0) << k;
        EXPECT_EQ(nusselt::LineSolidAngle<float>(nusselt::make_line(a, k * a)).measure(), 0) << k;
        EXPECT_EQ(nusselt::LineProjectedSolidAngle<float>(nusselt::make_line(-a, k * a)).measure(), 0) << k;
    }
}

/// Rounding of the edges, divided by the distance of a vertex almost at the point, overflowed.
TEST(RegressionTest, PolygonWithAVertexAlmostAtThePointStaysFinite) {
    const Quad light = quad({-9.8800797e-37f, 0, 0}, {-8.82394957e-09f, 3.15119379e-08f, 3.46915785e-09f},
                            {-1.76478991e-08f, 6.30238759e-08f, 6.9383157e-09f},
                            {8.82394957e-09f, -3.15119379e-08f, -3.46915785e-09f});
    expect_contract<PolygonClippedSolidAngleKindOf<4>>(light, {1.87669364e-08f, 0.56669569f});
}

/// Lights that fill a hemisphere, and samples at their first vertex, where the plane is seen edge-on.
TEST(RegressionTest, HemispheresKeepTheirFirstVertex) {
    const Quad along_the_surface =
        quad({-60.29739f, 9.22776413f, 0}, {-325.03772f, -1031.86768f, -1063.83374f},
             {146.348312f, -1150.14771f, -1109.21582f}, {580.917297f, -88.9021454f, 0});
    expect_contract<PolygonSolidAngleKindOf<4>>(along_the_surface, {0.972615123f, 0});
    const Quad close =
        quad({-0.0517238155f, 0.103447631f, -0.172414273f}, {-1.55172384f, 0.103447631f, -1.1724143f},
             {-0.551723838f, -0.896552384f, 0.827585697f}, {1.44827616f, 0.103447631f, 0.827585697f});
    expect_contract<PolygonSolidAngleKindOf<4>>(close, {0.774859369f, 0});
}

/// Where the plane of a light almost contains the point, the direction alone does not tell where on the light its hit point
/// is: hit points lay in the box around the light, but not in its plane.
TEST(RegressionTest, HitPointsOfLobesStayInAPlaneNextToThePoint) {
    using Kind = PolygonLtcKindOf<4>;
    const Quad first = quad({-2321.857f, -4608.007f, 4660.75f}, {-5384.853f, 224.07828f, -4394.536f},
                            {2046.3171f, 4572.515f, -4821.721f}, {2124.0242f, -3058.5879f, 5871.346f});
    expect_contract<Kind>({first, {0.0644569f, 0.9994510f, 0.423600f, -0.0289520f, 0.00348034f, 1}},
                          {0.121918f, 0});
    const Quad second = quad({0x1.ac86ccp+10f, 0x1.679f5p+10f, -0x1.e7cd2cp+10f},
                             {0x1.abcc66p+10f, -0x1.7e9194p+8f, 0x1.2b5a04p+11f},
                             {-0x1.2c81eap+11f, -0x1.4e7488p+10f, 0x1.15c844p+10f},
                             {-0x1.3171ap+11f, -0x1.73d016p+7f, -0x1.a27096p+10f});
    expect_contract<Kind>(
        {second, {0x1.585afcp-8f, 0x1.3ee8aap-6f, 0x1.010fa2p-5f, -0x1.1d95p-10f, 0x1.345e8ep-12f, 1}},
        {0x1.800b7cp-2f, 0});
}

/// Samples of a light, and how many of them would be in its own shadow: shadow rays end at 0.9999 of their length or so, so
/// a point that is farther behind the plane is.
struct ShadowCount {
    int samples = 0;
    int shadowed = 0;
};
template <class Technique>
void count_shadowed(const Quad& light, const Technique& technique, ShadowCount& count) {
    const auto normal = nusselt::broadcast<long double>(light.normal);
    const auto distance = static_cast<long double>(nusselt::plane_distance(light));
    for (int i = 0; i < 200; ++i) {
        const auto sample =
            technique.sample({(static_cast<float>(i) + 0.5f) / 200, static_cast<float>(i * 77 % 200) / 200});
        if (!(sample.pdf > 0)) continue;
        ++count.samples;
        const long double height = nusselt::dot(normal, nusselt::broadcast<long double>(sample.p));
        // Coordinates are at most 2, the normal and the sum of three products are rounded.
        EXPECT_LE(std::fabs(height - distance), 8 * std::numeric_limits<float>::epsilon());
        count.shadowed += 0.9999L * height / distance >= 1;
    }
}
/// \param height of the point above the plane; the squares have sides of length 1.
template <class Make>
ShadowCount shadows_of_squares(float height, const Make& make) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto direction = [&] {
        return normalize(nusselt::Vec3<float>{uniform(engine), uniform(engine), uniform(engine)});
    };
    ShadowCount count;
    for (int i = 0; i < 50; ++i) {
        const nusselt::Vec3<float> normal = direction();
        const nusselt::Vec3<float> side = 0.5f * normalize(cross(normal, direction()));
        const nusselt::Vec3<float> up = cross(normal, side);
        const auto corner = [&](float x, float y) { return height * normal + x * side + y * up; };
        const float x = 0.9f * uniform(engine), y = 0.9f * uniform(engine);
        const Quad light =
            quad(corner(x - 1, y - 1), corner(x + 1, y - 1), corner(x + 1, y + 1), corner(x - 1, y + 1));
        count_shadowed(light, make(light), count);
    }
    EXPECT_GT(count.samples, 4000);
    return count;
}
/// \param share of the samples that may be in the light's own shadow at a height of 1e-4: rounded corners are not in one plane.
template <class Make>
void expect_points_in_plane(const char* name, double share, const Make& make) {
    for (const float height : {1e-2f, 1e-3f})
        EXPECT_EQ(shadows_of_squares(height, make).shadowed, 0) << name << " at " << height;
    const ShadowCount closer = shadows_of_squares(1e-4f, make);
    EXPECT_LT(closer.shadowed, share * closer.samples) << name;
}
TEST(RegressionTest, HitPointsOfCloseLightsAreInTheirPlane) {
    using namespace nusselt;
    const Ltc<float> lobe(LtcCoefficients<float>{0.8f, 0.6f, 1, -0.06f, 0.08f, 1});
    using Light = const Quad&;
    expect_points_in_plane("projected", 0.03,
                           [](Light l) { return PolygonProjectedSolidAngle<float, 4>(l); });
    expect_points_in_plane("biased", 0.03,
                           [](Light l) { return PolygonProjectedSolidAngleBiased<float, 4>(l); });
    expect_points_in_plane("lobe", 0.03, [&](Light l) { return PolygonLtc<float, 4>(l, lobe); });
    expect_points_in_plane("clipped lobe", 0.03,
                           [&](Light l) { return PolygonClippedLtc<float, 4>(l, lobe); });
    expect_points_in_plane("biased lobe", 0.03, [&](Light l) { return PolygonLtcBiased<float, 4>(l, lobe); });
    expect_points_in_plane("solid angle", 0.03, [](Light l) { return PolygonSolidAngle<float, 4>(l); });
    // Sums of clipped vertices, which are rounded once more: 15 % with fused multiply-add, 21 % without.
    expect_points_in_plane("clipped", 0.3, [](Light l) { return PolygonClippedSolidAngle<float, 4>(l); });
}

/// The contract must not be content with the box around a light.
TEST(RegressionTest, ContractRejectsHitPointsBesideThePlane) {
    using Kind = PolygonSolidAngleKindOf<4>;
    const Quad light = quad({-1, -2, 1}, {1, -2, 1}, {1, 1, 2}, {-1, 1, 2});
    Outputs<float, nusselt::Vec2<float>> out = outputs_of<Kind, float>(light, {0.5f, 0.5f});
    EXPECT_EQ((violation<Kind, float>(light, out)), nullptr);
    out.sample.p = 1.002f * out.sample.p;
    EXPECT_STREQ((violation<Kind, float>(light, out)), "p is off the light");
}

/// Next to the horizon of a lobe, the point of its image and the direction were apart by up to 0.05.
TEST(RegressionTest, DirectionsNextToTheHorizonOfALobeLeadToTheirPoints) {
    const Quad light = quad({0x1.13ede8p+7f, -0x1.d3aa16p+8f, 0x1.8d5a38p+8f},
                            {-0x1.7bda2cp+7f, -0x1.20704ap+5f, 0x1.2b1feep+9f},
                            {-0x1.bf1258p+7f, 0x1.08fa0cp+9f, -0x1.00e252p+8f},
                            {0x1.66bb4ep+8f, -0x1.c842fcp+8f, -0x1.e9934p+7f});
    expect_contract<PolygonLtcKindOf<4>>(
        {light, {0x1.e6226p-1f, 0x1.5a2f66p-2f, 0x1.0a9f8ap+0f, -0x1.b46b1cp-14f, 0x1.b0a52p-13f, 1}},
        {0x1.d4df96p-1f, 0x1.fffffap-1f});
}

TEST(RegressionTest, ContractRejectsHitPointsBesideALine) {
    const Line light = nusselt::make_line(nusselt::Vec3<float>{-1, 0, 1}, nusselt::Vec3<float>{1, 1, 2});
    Outputs<float, float> out = outputs_of<LineSolidAngleKind, float>(light, 0.5f);
    EXPECT_EQ((violation<LineSolidAngleKind, float>(light, out)), nullptr);
    out.sample.p.z *= 1.002f;
    EXPECT_STREQ((violation<LineSolidAngleKind, float>(light, out)), "p is off the light");
}

/// The measure of a line has a unit, so it does not tell how much of a lobe reaches the light.
TEST(RegressionTest, ContractRejectsHitPointsBesideALongLineOnALobe) {
    const float size = 1e8f;
    const Line line =
        nusselt::make_line(nusselt::Vec3<float>{-size, 0, size}, nusselt::Vec3<float>{size, size, 2 * size});
    const nusselt_test::LineOnLobe<float> light{line, {0.8f, 0.6f, 1, -0.06f, 0.08f, 1}};
    Outputs<float, float> out = outputs_of<LineLtcKind, float>(light, 0.5f);
    EXPECT_EQ((violation<LineLtcKind, float>(light, out)), nullptr);
    EXPECT_LT(out.measure, std::numeric_limits<float>::epsilon());
    out.sample.p.z *= 1.002f;
    EXPECT_STREQ((violation<LineLtcKind, float>(light, out)), "p is off the light");
}

/// The last half-plane around an axis has hardly any density, and its image no importance.
TEST(RegressionTest, HalfPlanesWithoutImportanceHaveDirections) {
    const nusselt::Vec3<float> start{-0x1.b51e96p-122f, -0x1.d81f24p-124f, 0x1.1e4818p-123f};
    const nusselt::Vec3<float> end{-0x1.b52822p-122f, -0x1.d75e34p-124f, 0};
    expect_contract<CylinderLtcKind>(
        {{nusselt::make_line(start, end), 0x1.c4c2e4p-122f},
         {0x1.d676ep-33f, 0x1.94e31cp-9f, 0x1.629b38p-12f, -0x1.06217ep-12f, 0x1.30962ep-36f, 1}},
        {0x1.ffffcp-1f, 0});
}

#if NUSSELT_HAS_VERTEX_LANES
/// The bits of a technique in all lanes, made from one in memory that was filled with a byte before.
template <int N>
std::vector<unsigned char> bits_after(unsigned char fill, const nusselt::ConvexPolygon<float, N>& light) {
    using Single = nusselt::PolygonProjectedSolidAngle<float, N>;
    using Packed = nusselt::PolygonProjectedSolidAngle<nusselt::Pack<float, 4>, N>;
    alignas(64) unsigned char single[sizeof(Single)];
    std::memset(single, fill, sizeof single);
    const auto* technique = new (single) Single(light);
    alignas(64) unsigned char packed[sizeof(Packed)] = {};
    new (packed) Packed(*technique);
    return {std::begin(packed), std::end(packed)};
}

/// Sectors of lights that are not ordinary had what was in memory as their angle.
TEST(RegressionTest, TechniquesDoNotKeepWhatWasInMemory) {
    const nusselt::Vec3<float> lights[][4] = {
        {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},   // central
        {{1, -1, 1}, {3, -1, 1}, {3, 1, 1}, {1, 1, 1}},     // decentral
        {{2, -1, -1}, {2, 1, -1}, {2, 1, 1}, {2, -1, 1}},   // clipped
        {{2, -1, 1}, {2, 1, -1}, {2, 2, 3}, {2, 0, 4}},     // clipped, five vertices
        {{2, -1, 1}, {3, -1, 2}, {2, 0, 2}, {1, 0, 1}},     // general
        {{1, 0, 1}, {2, 0, 1}, {2, 0, 2}, {1, 1, 1}},       // with an edge in a vertical plane
        {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},       // the zenith is a vertex
        {{2, -1, -1}, {2, 1, -1}, {2, 1, -3}, {2, -1, -2}}, // below the horizon
        {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}},       // on the horizon
    };
    for (const auto& v : lights) {
        const Quad light = nusselt::make_polygon<4>(v, 4);
        EXPECT_EQ(bits_after<4>(0x42, light), bits_after<4>(0xff, light));
    }
}
#endif

} // namespace
} // namespace nusselt_test
