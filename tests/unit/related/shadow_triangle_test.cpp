/// The triangle between a point and a line against rays, and against points of a box.

#include <cmath>

#include <gtest/gtest.h>

#include <nusselt/related/shadow_triangle_billen.h>

#include "proof/hostile/lights.h"

namespace nusselt_test {
namespace {

using nusselt::Interval;
using nusselt::ShadowTriangle;
using nusselt::Vec3;
using nusselt::hostile::RandomSource;

Vec3<double> point(RandomSource& random) {
    return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

/// Whether the segment from a to b meets a triangle (Moeller and Trumbore's formulas).
bool meets(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double> (&corner)[3]) {
    const Vec3<double> e1 = corner[1] - corner[0];
    const Vec3<double> e2 = corner[2] - corner[0];
    const Vec3<double> direction = b - a;
    const Vec3<double> p = cross(direction, e2);
    const double determinant = dot(e1, p);
    const Vec3<double> s = a - corner[0];
    const double u = dot(s, p) / determinant;
    const Vec3<double> q = cross(s, e1);
    const double v = dot(direction, q) / determinant;
    const double t = dot(e2, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 1e-6 && t < nusselt::kShadowEnd<double>;
}

TEST(ShadowTriangle, HidesWhatRaysHit) {
    RandomSource random(1, 0);
    int hits = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec3<double> apex = point(random);
        const Vec3<double> begin = point(random);
        const Vec3<double> end = point(random);
        const Vec3<double> corner[3] = {point(random), point(random), point(random)};
        const Interval<double> hidden = ShadowTriangle<double>(apex, begin, end).hidden_by(corner);
        const double t = random.uniform();
        // Rounding decides at the ends.
        if (std::fabs(t - hidden.begin) < 1e-9 || std::fabs(t - hidden.end) < 1e-9) continue;
        const bool is_hit = meets(apex, begin + t * (end - begin), corner);
        hits += is_hit ? 1 : 0;
        EXPECT_EQ(t > hidden.begin && t < hidden.end, is_hit) << k;
    }
    EXPECT_GT(hits, 500);
}

/// Points of the triangle in the box prove an overlap, and a plane between the two disproves it.
TEST(ShadowTriangle, OverlapsBoxes) {
    RandomSource random(2, 0);
    int overlaps = 0;
    int apart = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec3<double> apex = point(random);
        const Vec3<double> begin = point(random);
        const Vec3<double> end = point(random);
        const Vec3<double> centre = point(random);
        const Vec3<double> half{random.between(0, 0.4), random.between(0, 0.4), random.between(0, 0.4)};
        const bool result = ShadowTriangle<double>(apex, begin, end).overlaps(centre, half);
        const double a = std::sqrt(random.uniform());
        const double b = random.uniform();
        const Vec3<double> inside = apex + a * (begin - apex) + (a * b) * (end - begin) - centre;
        if (std::fabs(inside.x) < half.x && std::fabs(inside.y) < half.y && std::fabs(inside.z) < half.z) {
            EXPECT_TRUE(result) << k;
            ++overlaps;
        }
        const Vec3<double> axis = random.direction();
        const double reach =
            half.x * std::fabs(axis.x) + half.y * std::fabs(axis.y) + half.z * std::fabs(axis.z);
        const double least =
            std::min({dot(axis, apex - centre), dot(axis, begin - centre), dot(axis, end - centre)});
        if (least > reach) {
            EXPECT_FALSE(result) << k;
            ++apart;
        }
    }
    EXPECT_GT(overlaps, 100);
    EXPECT_GT(apart, 500);
}

} // namespace
} // namespace nusselt_test
