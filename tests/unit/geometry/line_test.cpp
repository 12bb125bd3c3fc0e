/// Tests of line segments: extents, closed forms against quadrature, and clipping.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <nusselt/geometry/clip_line.h>

#include "geometry/reference.h"
#include "proof/hostile/lights.h"
#include "sampling/lights.h"

namespace nusselt_test {
namespace {

template <class T>
class LineTest : public ::testing::Test {
protected:
    static constexpr T kEpsilon = std::numeric_limits<T>::epsilon();
};

using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(LineTest, Scalars);

/// Solid angle per radius and length, seen from the origin, and the same times the cosine for the projected solid
/// angle.
struct LineIntegrand {
    Point s;
    long double solid_angle(const Point& p) const {
        return 2 * length(cross(p, s)) / (dot(p, p) * length(p));
    }
    long double projected(const Point& p) const { return solid_angle(p) * p.z / length(p); }
};

TYPED_TEST(LineTest, ClosedFormsAgreeWithQuadrature) {
    using T = TypeParam;
    for (const LineCase& light : line_cases()) {
        if (light.name == "long and close") continue; // beyond what a Gauss rule resolves
        const auto line = make_light<T>(light);
        const Point begin = widened_begin(line);
        const Point end = widened_end(line);
        const LineIntegrand integrand{nusselt::broadcast<long double>(line.s)};
        const auto solid = [&](const Point& p) { return integrand.solid_angle(p); };
        const auto projected = [&](const Point& p) { return integrand.projected(p); };
        const T tolerance = std::max(20 * this->kEpsilon, T(1e-15));
        EXPECT_NEAR(solid_angle(line) / integrate(begin, end, solid), 1, tolerance) << light.name;
        // The part above the horizon.
        const Point crossing = begin + (begin.z / (begin.z - end.z)) * (end - begin);
        const Point from = begin.z < 0 ? crossing : begin;
        const Point to = end.z < 0 ? crossing : end;
        EXPECT_NEAR(projected_solid_angle(line) / integrate(from, to, projected), 1, tolerance) << light.name;
        const auto extent = clipped_extent(to_safe_extent(line));
        EXPECT_NEAR(2 * extent.sine_extent().density * extent.distance / integrate(from, to, solid), 1,
                    tolerance)
            << light.name;
    }
}

TYPED_TEST(LineTest, ShortAndDistantLinesKeepTheirPrecision) {
    using T = TypeParam;
    // The point is almost on the line's axis, a thousand lengths away. A difference of sines would have no correct
    // digits.
    const auto line = make_light<T>(LineCase{"", {1000, 0.5, 3}, {1000.9, 0.5, 3.1}});
    const LineIntegrand integrand{nusselt::broadcast<long double>(line.s)};
    const long double expected = integrate(widened_begin(line), widened_end(line),
                                           [&](const Point& p) { return integrand.projected(p); });
    EXPECT_NEAR(projected_solid_angle(line) / expected, 1, std::max(20 * this->kEpsilon, T(1e-15)));
}

TYPED_TEST(LineTest, ExtentHasUnitVectors) {
    using T = TypeParam;
    HostileLights<T> hostile(1);
    for (int i = 0; i < 20'000; ++i) {
        const auto line = hostile.line();
        const auto e = clipped_extent(to_safe_extent(line));
        if (!e.visible()) continue;
        const auto t = e.inverse_distance() * e.line.closest;
        for (const auto& unit : {e.line.inward, t}) EXPECT_NEAR(length(unit), 1, 16 * this->kEpsilon);
        EXPECT_NEAR(dot(e.line.inward, t), 0, 4 * this->kEpsilon);
        EXPECT_NEAR(e.near_sine() * e.near_sine() + e.near_cosine() * e.near_cosine(), 1,
                    16 * this->kEpsilon);
        EXPECT_NEAR(e.far_sine() * e.far_sine() + e.far_cosine() * e.far_cosine(), 1, 16 * this->kEpsilon);
        EXPECT_GT(e.near_cosine(), 0);
        EXPECT_GT(e.far_cosine(), 0);
        EXPECT_GT(e.area(), 0);
        EXPECT_GT(e.sine_extent().difference, 0);
        EXPECT_LE(e.sine_extent().difference, 2 + 4 * this->kEpsilon);
    }
}

TYPED_TEST(LineTest, PointsOfTheExtentLieOnTheLine) {
    using T = TypeParam;
    for (const LineCase& light : line_cases()) {
        const auto line = make_light<T>(light);
        const auto e = whole_extent(to_safe_extent(line));
        const nusselt::LineMap<T> map(e);
        for (int i = 0; i <= 10; ++i) {
            const auto point = map.point_at(static_cast<T>(i) / 10);
            const auto p = map.position(point);
            const auto direction = map.direction(point, p);
            EXPECT_NEAR(length(direction), 1, 8 * this->kEpsilon) << light.name;
            EXPECT_LE(length(cross(p, direction)), 64 * this->kEpsilon * length(p)) << light.name;
            const T along = dot(p - line.p0, line.s);
            // The start of the line may be much farther away than the point.
            const T extent = std::max(length(p), length(line.p0));
            EXPECT_LE(length(p - line.p0 - along * line.s), 4 * this->kEpsilon * extent) << light.name;
            // The direction leads back to the point.
            EXPECT_NEAR(map.sine_extent * map.share_in(direction), map.sine_extent * point.share,
                        64 * this->kEpsilon)
                << light.name;
        }
    }
}

TYPED_TEST(LineTest, ShadingSpaceKeepsLengthAndDirection) {
    using T = TypeParam;
    const auto line = make_light<T>(LineCase{"", {40, 30, 20}, {40.001, 30.002, 20}});
    const auto frame = nusselt::Frame<T>::from_normal(normalize(nusselt::Vec3<T>{1, -2, 3}));
    const auto local = nusselt::to_shading_space(line, nusselt::Vec3<T>{1, 2, 3}, frame);
    EXPECT_EQ(local.length, line.length);
    EXPECT_NEAR(length(local.s), 1, 4 * this->kEpsilon);
    EXPECT_NEAR(local.s.z, dot(frame.n, line.s), 4 * this->kEpsilon);
}

} // namespace
} // namespace nusselt_test
