/// Tests of solid angles of rectangles that are known in closed form, and of the map of random numbers.

#include <nusselt/sampling/rectangle_solid_angle.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "lights.h"

namespace nusselt_test {
namespace {

using Technique = nusselt::RectangleSolidAngle<double>;
using Vec = nusselt::Vec3<double>;

constexpr double kPi = 3.14159265358979323846;

Technique rectangle(const Vec& corner, const Vec& a, const Vec& b) {
    const Vec vertices[] = {corner, corner + a, corner + a + b, corner + b};
    return Technique(nusselt::make_polygon<4>(vertices, 4));
}

TEST(RectangleSolidAngle, OfFacesOfACubeIsASixthOfTheSphere) {
    const double face = 4 * kPi / 6;
    EXPECT_NEAR(rectangle({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}).measure(), face, 1e-15);
    EXPECT_NEAR(rectangle({1, -1, -1}, {0, 0, 2}, {0, 2, 0}).measure(), face, 1e-15);
    EXPECT_NEAR(rectangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0}).measure(), face / 4, 1e-15)
        << "a corner below the point";
    EXPECT_NEAR(rectangle({0, -1, 1}, {1, 0, 0}, {0, 2, 0}).measure(), face / 2, 1e-15)
        << "an edge below the point";
}

// For such a light, the sum of angles minus two pi would have no correct digits.
TEST(RectangleSolidAngle, OfASmallLightKeepsItsDigits) {
    const auto light = rectangle({3, 4, 12}, {0x1p-30, 0, 0}, {0, 0x1p-30, 0});
    EXPECT_NEAR(light.measure() / (0x1p-60 * 12 / (13.0 * 13 * 13)), 1, 1e-9);
}

TEST(RectangleSolidAngle, IsTheSumOfItsParts) {
    const Vec a{1, 0, 0.5}, b{-0.25, 1.5, 0.5};
    const Vec corner{-0.375, 0.125, 1};
    const double whole = rectangle(corner, a, b).measure();
    for (const double share : {1e-6, 0.1, 0.375, 0.9}) {
        const double left = rectangle(corner, share * a, b).measure();
        const double right = rectangle(corner + share * a, (1 - share) * a, b).measure();
        EXPECT_NEAR((left + right) / whole, 1, 1e-13) << share;
    }
}

// Halving the range of u.x or u.y halves the light, without a seam between its two triangles.
TEST(RectangleSolidAngle, RandomNumbersMoveAlongTheEdges) {
    const Vec corner{-0.375, 0.125, 1}, a{1, 0, 0.5}, b{-0.25, 1.5, 0.5};
    const auto technique = rectangle(corner, a, b);
    for (const double y : {0.0, 0.3, 0.99}) {
        double last = -1;
        for (const double x : {0.0, 0.01, 0.5, 0.75, 0.999}) {
            const double along = dot(technique.sample({x, y}).p - corner, a) / dot(a, a);
            EXPECT_GT(along, last);
            EXPECT_NEAR(along, dot(technique.sample({x, 0.6}).p - corner, a) / dot(a, a), 1e-13)
                << "u.y does not move along the first edge";
            last = along;
        }
    }
}

TEST(RectangleSolidAngle, HasNoSampleInThePlaneOfTheLight) {
    EXPECT_EQ(rectangle({1, 0, 0}, {1, 0, 0}, {0, 1, 0}).sample({0.5, 0.5}).pdf, 0);
    EXPECT_EQ(rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}).sample({0.5, 0.5}).pdf, 0)
        << "the point is in the light";
    EXPECT_EQ(rectangle({1, 1, 1}, {0, 0, 0}, {0, 1, 0}).sample({0.5, 0.5}).pdf, 0);
}

TEST(RectangleSolidAngle, FillsAHemisphereNextToTheLightAndAQuarterOfTheSphereNextToItsEdge) {
    // The squares of these distances underflow.
    for (const double distance : {0x1p-500, 0x1p-600, 0x1p-760}) {
        const auto inside = rectangle({-1, -1, distance}, {2, 0, 0}, {0, 2, 0});
        EXPECT_NEAR(inside.measure(), 2 * kPi, 1e-14);
        const auto at_edge = rectangle({0, -1, distance}, {1, 0, 0}, {0, 2, 0});
        EXPECT_NEAR(at_edge.measure(), kPi, 1e-14);
        double mean_cosine = 0;
        constexpr int kSide = 64;
        for (int i = 0; i < kSide * kSide; ++i) {
            const nusselt::Vec2<double> u{(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide};
            const auto sample = inside.sample(u);
            EXPECT_NEAR(dot(sample.wi, sample.wi), 1, 1e-14);
            mean_cosine += sample.wi.z / (kSide * kSide);
            const auto aside = at_edge.sample(u);
            EXPECT_NEAR(dot(aside.wi, aside.wi), 1, 1e-14);
            EXPECT_GE(aside.wi.x, 0);
        }
        EXPECT_NEAR(mean_cosine, 0.5, 1e-3) << "directions are not uniform";
    }
}

} // namespace
} // namespace nusselt_test
