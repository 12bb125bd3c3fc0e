/// Tests that the winding, unused vertex slots and the unit of length do not change the result.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "contract.h"
#include "lights.h"

namespace nusselt_test {
namespace {

template <class T>
class InvarianceTest : public ::testing::Test {};

using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(InvarianceTest, Scalars);

template <class T>
void expect_equal(const nusselt::Vec3<T>& a, const nusselt::Vec3<T>& b) {
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, b.y);
    EXPECT_EQ(a.z, b.z);
}

TYPED_TEST(InvarianceTest, MeasureDoesNotDependOnTheWinding) {
    using T = TypeParam;
    for (PolygonCase light : polygon_cases()) {
        const auto one = make_light<T>(light);
        std::reverse(light.vertices.begin(), light.vertices.end());
        const auto other = make_light<T>(light);
        const auto expect_same = [&](T a, T b) {
            EXPECT_NEAR(a / b, 1, 4000 * std::numeric_limits<T>::epsilon()) << light.name;
        };
        expect_same(nusselt::PolygonArea<T, 4>(one).measure(), nusselt::PolygonArea<T, 4>(other).measure());
        expect_same(nusselt::PolygonSolidAngle<T, 4>(one).measure(),
                    nusselt::PolygonSolidAngle<T, 4>(other).measure());
        expect_same(nusselt::PolygonClippedSolidAngle<T, 4>(one).measure(),
                    nusselt::PolygonClippedSolidAngle<T, 4>(other).measure());
        expect_same(nusselt::PolygonProjectedSolidAngle<T, 4>(one).measure(),
                    nusselt::PolygonProjectedSolidAngle<T, 4>(other).measure());
    }
}

template <template <class, int> class Technique, class T>
void expect_same_with_unused_slots(const nusselt::ConvexPolygon<T, 4>& light, const nusselt::Vec2<T>& u) {
    const Technique<T, 4> tight(light);
    const Technique<T, 8> loose(nusselt::make_polygon<8>(light.vertex, 4));
    const auto a = tight.sample(u);
    const auto b = loose.sample(u);
    EXPECT_EQ(tight.measure(), loose.measure());
    EXPECT_EQ(a.pdf, b.pdf);
    if (!(a.pdf > 0)) return;
    expect_equal(a.wi, b.wi);
    expect_equal(a.p, b.p);
}

template <class T, int N>
using ProjectedSolidAngle = nusselt::PolygonProjectedSolidAngle<T, N>;

TYPED_TEST(InvarianceTest, UnusedSlotsChangeNothing) {
    using T = TypeParam;
    HostileLights<T> hostile(5);
    for (int i = 0; i < 2000; ++i) {
        const auto light = hostile.polygon();
        const auto u = hostile_random<PolygonAreaKind>(hostile);
        expect_same_with_unused_slots<nusselt::PolygonArea, T>(light, u);
        expect_same_with_unused_slots<nusselt::PolygonSolidAngle, T>(light, u);
        expect_same_with_unused_slots<nusselt::PolygonClippedSolidAngle, T>(light, u);
    }
    // Hostile lights are left out here: where azimuths are equal up to rounding, the sorting networks may order
    // vertices differently.
    for (const PolygonCase& light : polygon_cases()) {
        for (const auto& u : midpoints<PolygonAreaKind, T>(5)) {
            expect_same_with_unused_slots<ProjectedSolidAngle, T>(make_light<T>(light), u);
        }
    }
}

TYPED_TEST(InvarianceTest, EightVertices) {
    // The measure of a regular octagon at height 1 with circumradius 1 is eight times that of the triangle under one
    // edge.
    using T = TypeParam;
    nusselt::Vec3<T> vertices[8] = {};
    for (int j = 0; j < 8; ++j) {
        const T angle = static_cast<T>(j) * nusselt::kPi<T> / 4;
        vertices[j] = {std::cos(angle), std::sin(angle), T(1)};
    }
    const auto octagon = nusselt::make_polygon<8>(vertices, 8);
    const T apothem = std::cos(nusselt::kPi<T> / 8);
    const T edge = 2 * std::atan2(std::sin(nusselt::kPi<T> / 8), std::sqrt(1 + apothem * apothem));
    const T expected = 4 * edge * apothem / std::sqrt(1 + apothem * apothem);
    const nusselt::PolygonProjectedSolidAngle<T, 8> technique(octagon);
    EXPECT_NEAR(technique.measure() / expected, 1, 32 * std::numeric_limits<T>::epsilon());
    EXPECT_NEAR((nusselt::PolygonArea<T, 8>(octagon).measure()), 2 * std::sqrt(T(2)),
                32 * std::numeric_limits<T>::epsilon());
}

template <class T>
nusselt::ConvexPolygon<T, 4> rescaled(nusselt::ConvexPolygon<T, 4> polygon, T scale) {
    for (auto& v : polygon.vertex) v = scale * v;
    for (auto& e : polygon.edge) e = scale * e;
    return polygon;
}
template <class T>
nusselt::LineSegment<T> rescaled(const nusselt::LineSegment<T>& line, T scale) {
    return {scale * line.p0, line.s, scale * line.length};
}

/// \param measure_scale factor of the measure if lengths are multiplied by `scale`.
template <class Technique, class Light, class Random, class T>
void expect_scaled(const Light& light, const Random& u, T scale, T measure_scale, T pdf_scale) {
    const Technique one(light);
    const Technique other(rescaled(light, scale));
    EXPECT_EQ(measure_scale * one.measure(), other.measure());
    const auto a = one.sample(u);
    const auto b = other.sample(u);
    EXPECT_EQ(pdf_scale * a.pdf, b.pdf);
    expect_equal(a.wi, b.wi);
    expect_equal(scale * a.p, b.p);
}

TYPED_TEST(InvarianceTest, ScalesByPowersOfTwo) {
    using T = TypeParam;
    RandomSource random(6);
    for (const T scale : {T(0x1p-20), T(0.5), T(1024), T(0x1p30)}) {
        for (const PolygonCase& light : polygon_cases()) {
            const auto polygon = make_light<T>(light);
            const nusselt::Vec2<T> u{static_cast<T>(random.uniform() * 0.999),
                                     static_cast<T>(random.uniform() * 0.999)};
            expect_scaled<nusselt::PolygonArea<T, 4>>(polygon, u, scale, scale * scale, T(1));
            expect_scaled<nusselt::PolygonSolidAngle<T, 4>>(polygon, u, scale, T(1), T(1));
            expect_scaled<nusselt::PolygonClippedSolidAngle<T, 4>>(polygon, u, scale, T(1), T(1));
            expect_scaled<nusselt::PolygonProjectedSolidAngle<T, 4>>(polygon, u, scale, T(1), T(1));
        }
        for (const LineCase& light : line_cases()) {
            const auto line = make_light<T>(light);
            const T u = static_cast<T>(random.uniform() * 0.999);
            // The unit of the density is m / sr.
            expect_scaled<nusselt::LineArea<T>>(line, u, scale, scale, scale);
            expect_scaled<nusselt::LineSolidAngle<T>>(line, u, scale, 1 / scale, scale);
            expect_scaled<nusselt::LineClippedSolidAngle<T>>(line, u, scale, 1 / scale, scale);
            expect_scaled<nusselt::LineProjectedSolidAngle<T>>(line, u, scale, 1 / scale, scale);
        }
    }
}

TYPED_TEST(InvarianceTest, RotationAboutTheNormalKeepsMeasures) {
    using T = TypeParam;
    for (const PolygonCase& light : polygon_cases()) {
        PolygonCase turned = light;
        for (auto& v : turned.vertices) v = {0.6 * v.x - 0.8 * v.y, 0.8 * v.x + 0.6 * v.y, v.z};
        const T one = nusselt::PolygonProjectedSolidAngle<T, 4>(make_light<T>(light)).measure();
        const T other = nusselt::PolygonProjectedSolidAngle<T, 4>(make_light<T>(turned)).measure();
        // The rotation itself is computed in double.
        const T tolerance = 4000 * std::max(std::numeric_limits<T>::epsilon(),
                                            static_cast<T>(std::numeric_limits<double>::epsilon()));
        EXPECT_NEAR(one / other, 1, tolerance) << light.name;
    }
}

} // namespace
} // namespace nusselt_test
