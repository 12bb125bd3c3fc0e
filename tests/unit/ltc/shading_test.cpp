/// Compares analytic shading with quadrature, which shares no formula with it.

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "geometry/adaptive_quadrature.h"
#include "lobes.h"
#include "reference.h"
#include "sampling/lights.h"

#include <nusselt/estimate/reference_integrals.h>
#include <nusselt/ltc/line_shading.h>
#include <nusselt/ltc/polygon_shading.h>
#include <nusselt/sampling/line_ltc.h>
#include <nusselt/sampling/polygon_ltc.h>

namespace nusselt_test {
namespace {

using nusselt::BothHorizons;
using nusselt::Ltc;

constexpr Point kUp{0, 0, 1};

template <class T>
class ShadingTest : public ::testing::Test {
public:
    static constexpr double kBudget = sizeof(T) == 4 ? 1e-5 : 1e-12;
    /// Errors are relative above this share of a lobe and absolute below it.
    static constexpr double kFaint = 1e-2;

    static void expect_close(T value, long double expected, const std::string& name) {
        const auto scale = std::max(static_cast<double>(expected), kFaint);
        EXPECT_NEAR(static_cast<double>(value), static_cast<double>(expected), kBudget * scale) << name;
    }
    /// Like expect_close, but always relative.
    static void expect_accurate(T value, long double expected, const std::string& name) {
        EXPECT_NEAR(static_cast<double>(value / expected), 1, kBudget) << name;
    }
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ShadingTest, Scalars);

TYPED_TEST(ShadingTest, PolygonsAreIntegratedUpToBothHorizons) {
    using T = TypeParam;
    for (const NamedLobe& named : wide_lobes()) {
        const auto coefficients = rounded<T>(named.coefficients);
        const Ltc<T> ltc(coefficients);
        const ReferenceLobe lobe(coefficients);
        const auto density = [&](const Point& wi) { return lobe.density(wi); };
        for (const PolygonCase& light : polygon_cases()) {
            const auto local = make_light<T>(light);
            const std::string name = light.name + ", " + named.name;
            const Polygon in_lobe = cut(vertices_of(local), lobe.horizon());
            const Polygon above = cut(in_lobe, kUp);
            const auto integral = [&](const Polygon& part) {
                return part.size() < 3 ? 0 : integrate_solid_angle(part, density, 1e-15L);
            };
            const long double all = integral(in_lobe);
            const long double lit = integral(above);
            TestFixture::expect_close(lobe_integral(local, ltc), all, name);
            TestFixture::expect_close(lobe_integral<BothHorizons>(local, ltc), lit, name);
            if (all < 1e-4L) continue;
            TestFixture::expect_accurate(nusselt::PolygonLtc<T, 4>(local, ltc).measure(), all, name);
            TestFixture::expect_accurate(nusselt::PolygonClippedLtc<T, 4>(local, ltc).measure(), lit, name);
        }
    }
}

TYPED_TEST(ShadingTest, LinesAreIntegratedUpToBothHorizons) {
    using T = TypeParam;
    for (const NamedLobe& named : wide_lobes()) {
        const auto coefficients = rounded<T>(named.coefficients);
        const Ltc<T> ltc(coefficients);
        const ReferenceLobe lobe(coefficients);
        const auto density = [&](const Point& wi) { return lobe.density(wi); };
        for (const LineCase& light : line_cases()) {
            const auto local = make_light<T>(light);
            const std::string name = light.name + ", " + named.name;
            const Segment whole{widened_begin(local), widened_end(local)};
            if (std::max(dot(whole.begin, lobe.horizon()), dot(whole.end, lobe.horizon())) <= 0) {
                EXPECT_EQ(lobe_integral(local, ltc), 0) << name;
                continue;
            }
            const Segment in_lobe = cut(whole, lobe.horizon());
            const long double all = integrate_per_radius(in_lobe, density);
            TestFixture::expect_accurate(lobe_integral(local, ltc), all, name);
            TestFixture::expect_accurate(nusselt::LineLtc<T>(local, ltc).measure(), all, name);
            if (std::max(in_lobe.begin.z, in_lobe.end.z) <= 0) continue;
            const long double lit = integrate_per_radius(cut(in_lobe, kUp), density);
            TestFixture::expect_accurate(lobe_integral<BothHorizons>(local, ltc), lit, name);
            TestFixture::expect_accurate(nusselt::LineClippedLtc<T>(local, ltc).measure(), lit, name);
        }
    }
}

TYPED_TEST(ShadingTest, DiffuseIntegralsAreThoseOfTheIdentity) {
    using T = TypeParam;
    const ReferenceLobe lambertian(nusselt::LtcCoefficients<T>{1, 0, 1, 0, 1, 1});
    const auto density = [&](const Point& wi) { return lambertian.density(wi); };
    for (const PolygonCase& light : polygon_cases()) {
        const auto local = make_light<T>(light);
        TestFixture::expect_close(diffuse_integral(local),
                                  integrate_solid_angle(above_horizon(vertices_of(local)), density, 1e-15L),
                                  light.name);
    }
    for (const LineCase& light : line_cases()) {
        const auto local = make_light<T>(light);
        const Segment above = cut(Segment{widened_begin(local), widened_end(local)}, kUp);
        TestFixture::expect_accurate(diffuse_integral(local), integrate_per_radius(above, density),
                                     light.name);
    }
}

TYPED_TEST(ShadingTest, NothingComesFromDegenerateLights) {
    using T = TypeParam;
    const Ltc<T> ltc(rounded<T>(wide_lobes().back().coefficients));
    const nusselt::Vec3<T> p{T(0.25), T(0.5), 1};
    const auto point = nusselt::make_line(p, p);
    const auto through_origin = nusselt::make_line(-p, p);
    for (const auto& line : {point, through_origin}) {
        EXPECT_EQ(lobe_integral(line, ltc), 0);
        EXPECT_EQ(diffuse_integral(line), 0);
        EXPECT_EQ(lobe_integral<BothHorizons>(line, ltc), 0);
    }
    const nusselt::Vec3<T> vertices[] = {p, p + p, p, p};
    EXPECT_EQ(lobe_integral(nusselt::make_polygon<4>(vertices, 4), ltc), 0);
}

// The following tests compare approximations with references, so they use doubles.

const nusselt::LineSegment<double> kTube =
    nusselt::make_line(nusselt::Vec3<double>{-0.5, 0.2, 1}, nusselt::Vec3<double>{0.75, 0.4, 1.25});

Ltc<double> lobe_of_tubes() { return Ltc<double>(rounded<double>(tilted_lobe(0.3L, 0.5L, 1.1L, 0.1L))); }

TEST(ReferenceIntegralsTest, LineConvergesWithTheSquareOfTheStep) {
    const Ltc<double> ltc = lobe_of_tubes();
    const auto density = [&](const nusselt::Vec3<double>& wi) { return ltc.density(wi); };
    const double exact = lobe_integral(kTube, ltc);
    const auto error = [&](int steps) {
        return std::fabs(reference_line_integral(kTube, density, steps) / exact - 1);
    };
    EXPECT_LT(error(100), 1e-4);
    EXPECT_NEAR(error(100) / error(200), 4, 0.1);
    EXPECT_NEAR(error(200) / error(400), 4, 0.1);
}

/// Compares the lateral surface, to first order in the radius, with the line.
TEST(ReferenceIntegralsTest, TubeTendsToItsAxis) {
    const Ltc<double> ltc = lobe_of_tubes();
    const auto density = [&](const nusselt::Vec3<double>& wi) { return ltc.density(wi); };
    const double line = lobe_integral(kTube, ltc);
    const auto error = [&](double radius) {
        const double tube = reference_tube_integral(kTube, radius, density, 400, 400);
        return tube / nusselt::tube_integral(line, radius) - 1;
    };
    EXPECT_LT(std::fabs(error(0.02)), 0.05);
    EXPECT_NEAR(error(0.02) / error(0.01), 2, 0.2);
    EXPECT_NEAR(error(0.01) / error(0.005), 2, 0.2);
}

TEST(ReferenceIntegralsTest, CapsTendToDisksAtTheEnds) {
    const Ltc<double> ltc = lobe_of_tubes();
    const auto density = [&](const nusselt::Vec3<double>& wi) { return ltc.density(wi); };
    // The disk at one end is seen from outside, that at the other end from behind.
    const auto line =
        nusselt::make_line(nusselt::Vec3<double>{0.3, 0.2, 1}, nusselt::Vec3<double>{0.75, 0.4, 3});
    const auto error = [&](double radius) {
        const double disks = reference_caps_integral(line, radius, density, 100, 200);
        return disks / caps_integral(line, radius, density) - 1;
    };
    EXPECT_GT(caps_integral(line, 0.1, density), 1e-3);
    EXPECT_LT(std::fabs(error(0.05)), 0.02);
    EXPECT_NEAR(error(0.05) / error(0.025), 4, 0.4);
}

/// The cases include strips that face the point and strips seen edge-on.
TEST(ReferenceIntegralsTest, StripTendsToItsMiddleLine) {
    const Ltc<double> ltc = lobe_of_tubes();
    const auto density = [&](const nusselt::Vec3<double>& wi) { return ltc.density(wi); };
    const double line = lobe_integral(kTube, ltc);
    const auto u = normalize(cross(kTube.p0, kTube.s));
    const auto t = cross(kTube.s, u);
    for (const double angle : {0.0, 0.6, 1.2, -0.6}) {
        const auto normal = std::cos(angle) * t + std::sin(angle) * u;
        const auto error = [&](double width) {
            const double strip = reference_strip_integral(kTube, normal, width, density, 100, 1000);
            return std::fabs(strip / strip_integral(kTube, normal, width, line) - 1);
        };
        EXPECT_LT(error(0.01), 0.03) << angle;
        EXPECT_LT(error(0.005), 0.6 * error(0.01) + 1e-5) << angle;
    }
    EXPECT_NEAR(strip_integral(kTube, u, 0.01, line), 0, 1e-15);
}

TEST(TubeShadingTest, IsAtMostTheWholeLobe) {
    EXPECT_EQ(nusselt::tube_integral(3.0, 0.1), 3.0 * 0.1);
    EXPECT_EQ(nusselt::tube_integral(30.0, 0.1), 1);
    EXPECT_EQ(nusselt::tube_integral(3.0, 0.125, 0.25), 0.625);
    EXPECT_EQ(nusselt::tube_integral(3.0, 0.125, 0.75), 1);
    const nusselt::Vec3<double> across{0, 0, 1};
    const auto line = nusselt::make_line(nusselt::Vec3<double>{-1, 0, 1}, nusselt::Vec3<double>{1, 0, 1});
    EXPECT_EQ(strip_integral(line, across, 1.0, 0.5), 0.25);
    EXPECT_EQ(strip_integral(line, across, 1.0, 50.0), 1);
}

TEST(TubeShadingTest, CapsThatTouchThePointAreFinite) {
    const Ltc<double> ltc = lobe_of_tubes();
    const auto density = [&](const nusselt::Vec3<double>& wi) { return ltc.density(wi); };
    const auto line = nusselt::make_line(nusselt::Vec3<double>{0, 0, 0}, nusselt::Vec3<double>{0, 0, 1});
    EXPECT_EQ(caps_integral(line, 0.1, density), 0);
}

} // namespace
} // namespace nusselt_test
