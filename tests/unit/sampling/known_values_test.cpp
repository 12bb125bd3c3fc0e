/// Tests of measures that are known in closed form and of the edge cases of the contract, for every number type.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "contract.h"
#include "lights.h"

namespace nusselt_test {
namespace {

constexpr long double kPi = 3.141592653589793238462643383279502884L;

template <class Real>
class KnownValuesTest : public ::testing::Test {
public:
    using Scalar = nusselt::scalar_t<Real>;

    static nusselt::ConvexPolygon<Real, 4> polygon(const std::vector<nusselt::Vec3<double>>& vertices) {
        return in_all_lanes<nusselt::ConvexPolygon<Real, 4>>(make_light<Scalar>(PolygonCase{"", vertices}));
    }
    static nusselt::LineSegment<Real> line(const nusselt::Vec3<double>& begin,
                                           const nusselt::Vec3<double>& end) {
        return in_all_lanes<nusselt::LineSegment<Real>>(make_light<Scalar>(LineCase{"", begin, end}));
    }

    /// Compares the last lane only, since all lanes are equal.
    static void expect_near(const Real& actual, long double expected) {
        EXPECT_NEAR(last_lane(actual), expected,
                    16 * std::numeric_limits<Scalar>::epsilon() * std::fabs(expected));
    }

    template <class Technique, class Random>
    static void expect_dark(const Technique& technique, const Random& u) {
        const auto sample = technique.sample(u);
        EXPECT_EQ(last_lane(sample.pdf), 0);
        EXPECT_EQ(last_lane(technique.pdf(sample.wi)), 0);
        EXPECT_TRUE(all_finite(get_lane<Scalar, nusselt::Vec3<Scalar>>(sample.wi, kLanes - 1)));
        EXPECT_TRUE(all_finite(get_lane<Scalar, nusselt::Vec3<Scalar>>(sample.p, kLanes - 1)));
    }

    template <class Technique, class Random>
    static void expect_lit(const Technique& technique, const Random& u) {
        EXPECT_GT(last_lane(technique.sample(u).pdf), 0);
        EXPECT_GT(last_lane(technique.measure()), 0);
    }

    static Scalar last_lane(const Real& x) { return get_lane<Scalar, Scalar>(x, kLanes - 1); }

private:
    static constexpr int kLanes = nusselt::RealTraits<Real>::kLanes;

    template <class Packed, class Single>
    static Packed in_all_lanes(const Single& single) {
        Packed packed;
        for (int i = 0; i < kLanes; ++i) set_lane<Scalar>(packed, i, single);
        return packed;
    }
};

using Reals = ::testing::Types<float, double, long double, NativeFloat, NativeDouble>;
TYPED_TEST_SUITE(KnownValuesTest, Reals);

TYPED_TEST(KnownValuesTest, SquareOverhead) {
    const auto light = this->polygon({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}});
    this->expect_near(nusselt::PolygonArea<TypeParam, 4>(light).measure(), 4);
    this->expect_near(nusselt::PolygonSolidAngle<TypeParam, 4>(light).measure(), 2 * kPi / 3);
    this->expect_near(nusselt::PolygonClippedSolidAngle<TypeParam, 4>(light).measure(), 2 * kPi / 3);
    // Four times the form factor of a rectangle, seen from below one of its corners.
    this->expect_near(nusselt::PolygonProjectedSolidAngle<TypeParam, 4>(light).measure(),
                      4 * std::sqrt(0.5L) * std::atan(std::sqrt(0.5L)));
}

TYPED_TEST(KnownValuesTest, Octant) {
    const auto light = this->polygon({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    this->expect_near(nusselt::PolygonArea<TypeParam, 4>(light).measure(), std::sqrt(3.0L) / 2);
    this->expect_near(nusselt::PolygonSolidAngle<TypeParam, 4>(light).measure(), kPi / 2);
    this->expect_near(nusselt::PolygonClippedSolidAngle<TypeParam, 4>(light).measure(), kPi / 2);
    this->expect_near(nusselt::PolygonProjectedSolidAngle<TypeParam, 4>(light).measure(), kPi / 4);
}

TYPED_TEST(KnownValuesTest, OctantWithItsReflection) {
    // Clipping techniques only see the triangle above the horizon.
    const auto light = this->polygon({{1, 0, 0.5}, {0, 1, 0.5}, {0, 1, -0.5}, {1, 0, -0.5}});
    const TypeParam whole = nusselt::PolygonSolidAngle<TypeParam, 4>(light).measure();
    const TypeParam upper = nusselt::PolygonClippedSolidAngle<TypeParam, 4>(light).measure();
    this->expect_near(whole / upper, 2);
}

TYPED_TEST(KnownValuesTest, HemisphereFillingSquare) {
    const auto light =
        this->polygon({{-1e6, -1e6, 0.125}, {1e6, -1e6, 0.125}, {1e6, 1e6, 0.125}, {-1e6, 1e6, 0.125}});
    const auto projected =
        this->last_lane(nusselt::PolygonProjectedSolidAngle<TypeParam, 4>(light).measure());
    const auto solid = this->last_lane(nusselt::PolygonSolidAngle<TypeParam, 4>(light).measure());
    EXPECT_NEAR(projected, kPi, 2e-6);
    EXPECT_NEAR(solid, 2 * kPi, 4e-6);
}

TYPED_TEST(KnownValuesTest, SymmetricLine) {
    const auto light = this->line({-1, 0, 1}, {1, 0, 1});
    this->expect_near(nusselt::LineArea<TypeParam>(light).measure(), 2);
    this->expect_near(nusselt::LineSolidAngle<TypeParam>(light).measure(), 2 * std::sqrt(2.0L));
    this->expect_near(nusselt::LineClippedSolidAngle<TypeParam>(light).measure(), 2 * std::sqrt(2.0L));
    this->expect_near(nusselt::LineProjectedSolidAngle<TypeParam>(light).measure(), kPi / 2 + 1);
}

TYPED_TEST(KnownValuesTest, LineFromAboveThePoint) {
    const auto light = this->line({0, 0, 1}, {1, 0, 1});
    this->expect_near(nusselt::LineSolidAngle<TypeParam>(light).measure(), std::sqrt(2.0L));
    this->expect_near(nusselt::LineProjectedSolidAngle<TypeParam>(light).measure(), kPi / 4 + 0.5L);
}

TYPED_TEST(KnownValuesTest, VerticalLineThroughTheHorizon) {
    const auto light = this->line({2, 0, -2}, {2, 0, 2});
    this->expect_near(nusselt::LineSolidAngle<TypeParam>(light).measure(), std::sqrt(2.0L));
    this->expect_near(nusselt::LineClippedSolidAngle<TypeParam>(light).measure(), std::sqrt(2.0L) / 2);
    this->expect_near(nusselt::LineProjectedSolidAngle<TypeParam>(light).measure(), 0.25L);
}

TYPED_TEST(KnownValuesTest, PolygonsWithoutSamples) {
    const nusselt::Vec2<TypeParam> u{TypeParam(0.25), TypeParam(0.75)};
    for (const auto& vertices : std::vector<std::vector<nusselt::Vec3<double>>>{
             {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}},               // a point
             {{1, 0, 1}, {2, 0, 2}, {3, 0, 3}},               // no area, seen as a point
             {{1, 0, 1}, {1, 1, 1}, {1, 3, 1}, {1, 2, 1}},    // no area, seen as a line
             {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},  // the point lies in it
             {{1, 0, 0}, {2, 1, 0}, {3, -1, 0}},              // the point lies in its plane, the horizon
             {{1, 0, 1}, {2, 0, 1}, {2, 0, 3}, {1, 0, 3}},    // the point lies in its plane, a wall
             {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}}) { // the point is a vertex
        const auto light = this->polygon(vertices);
        this->expect_dark(nusselt::PolygonArea<TypeParam, 4>(light), u);
        this->expect_dark(nusselt::PolygonSolidAngle<TypeParam, 4>(light), u);
        this->expect_dark(nusselt::PolygonClippedSolidAngle<TypeParam, 4>(light), u);
        this->expect_dark(nusselt::PolygonProjectedSolidAngle<TypeParam, 4>(light), u);
        this->expect_dark(nusselt::PolygonProjectedSolidAngleBiased<TypeParam, 4>(light), u);
    }
}

TYPED_TEST(KnownValuesTest, LightsBelowTheHorizon) {
    const auto polygon = this->polygon({{1, 0, -1}, {2, 0, -1}, {2, 1, 0}, {1, 1, 0}});
    const nusselt::Vec2<TypeParam> u{TypeParam(0.25), TypeParam(0.75)};
    this->expect_dark(nusselt::PolygonClippedSolidAngle<TypeParam, 4>(polygon), u);
    this->expect_dark(nusselt::PolygonProjectedSolidAngle<TypeParam, 4>(polygon), u);
    const auto line = this->line({1, 0, -1}, {2, 1, -0.25});
    this->expect_dark(nusselt::LineClippedSolidAngle<TypeParam>(line), u.x);
    this->expect_dark(nusselt::LineProjectedSolidAngle<TypeParam>(line), u.x);
    // The other techniques ignore the horizon.
    this->expect_lit(nusselt::PolygonSolidAngle<TypeParam, 4>(polygon), u);
    this->expect_lit(nusselt::LineSolidAngle<TypeParam>(line), u.x);
}

TYPED_TEST(KnownValuesTest, LinesWithoutSamples) {
    const TypeParam u(0.25);
    for (const auto& [begin, end] : std::vector<std::pair<nusselt::Vec3<double>, nusselt::Vec3<double>>>{
             {{1, 0.5, 1}, {1, 0.5, 1}},  // no length
             {{1, 0.5, 1}, {2, 1, 2}},    // directed at the point
             {{-1, -0.5, -1}, {2, 1, 2}}, // passes through the point
             {{0, 0, 0}, {1, 1, 1}}}) {   // starts at the point
        const auto light = this->line(begin, end);
        this->expect_dark(nusselt::LineArea<TypeParam>(light), u);
        this->expect_dark(nusselt::LineSolidAngle<TypeParam>(light), u);
        this->expect_dark(nusselt::LineClippedSolidAngle<TypeParam>(light), u);
        this->expect_dark(nusselt::LineProjectedSolidAngle<TypeParam>(light), u);
    }
}

} // namespace
} // namespace nusselt_test
