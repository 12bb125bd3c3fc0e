/// Solid angle sampling with warped random numbers (Hart et al. 2020): how much variance the warps remove, and where the
/// method fails.

#include "lab/timing/scalar/lights.h"
#include "warp_checks.h"

#include <gtest/gtest.h>

#include <random>

namespace nusselt::warp_test {

namespace {

/// The largest difference between the cosines that the fit takes from the vertices and those of samples in the corners.
template <template <class, int> class Base, int N>
double corner_error(const lab::LightClass& lights) {
    std::mt19937 generator(3);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto corners = lab::random_light(lights, N, generator);
        const auto light = make_polygon<N>(corners.data(), N);
        const Base<double, N> base(light);
        if (!(base.measure() > 1e-3)) continue;
        const auto cosine = [&](double x, double y) {
            return std::max(base.sample({below_one(x), below_one(y)}).wi.z, 0.0);
        };
        const auto c = hart::corner_cosines(light, base);
        worst = std::max({worst, std::fabs(cosine(0, 0) - c.apex), std::fabs(cosine(1, 0) - c.apex),
                          std::fabs(cosine(0, 1) - c.first), std::fabs(cosine(1, 1) - c.last)});
    }
    return worst;
}

TEST(PolygonWarpHart, TakesTheCosinesOfTheCorners) {
    // Next to the end, the square root of one rounding remains.
    constexpr double kTolerance = 1e-7;
    for (const lab::LightClass& lights : {lab::kDecentral, lab::kCentral, lab::kCrossing}) {
        EXPECT_LE((corner_error<PolygonSolidAngle, 3>(lights)), kTolerance) << lights.name;
        EXPECT_LE((corner_error<PolygonSolidAngle, 5>(lights)), kTolerance) << lights.name;
        EXPECT_LE((corner_error<PolygonClippedSolidAngle, 3>(lights)), kTolerance) << lights.name;
        EXPECT_LE((corner_error<PolygonClippedSolidAngle, 4>(lights)), kTolerance) << lights.name;
        EXPECT_LE((corner_error<PolygonClippedSolidAngle, 8>(lights)), kTolerance) << lights.name;
    }
}

/// Of quadrilaterals.
template <template <class, int> class Technique>
double deviation_of_polygon(const Corners& corners) {
    using Kind = OfPolygon<Technique, PolygonSolidAngle, 4>;
    return moments<Technique<double, 4>, Kind>(corners, 100).deviation;
}

TEST(PolygonWarpHart, ReducesTheVariance) {
    for (const int i : {0, 1, 3, 7}) {
        const Corners light = polygons()[static_cast<std::size_t>(i)];
        const double base = deviation_of_polygon<PolygonSolidAngle>(light);
        const double bilinear = deviation_of_polygon<PolygonBilinearWarpHart>(light);
        const double biquadratic = deviation_of_polygon<PolygonBiquadraticWarpHart>(light);
        EXPECT_LT(bilinear, 0.95 * base) << i;
        EXPECT_LT(biquadratic, 0.8 * bilinear) << i;
    }
}

TEST(PolygonWarpHart, IgnoresVerticesFarFromTheFirstOne) {
    // A failure of the method: only vertex 2 is above the horizon, so the bilinear warp is the identity.
    const Corners light = polygons()[8];
    const auto polygon = OfPolygon<PolygonBilinearWarpHart, PolygonSolidAngle, 4>::make<double>(light);
    const PolygonBilinearWarpHart<double, 4> technique(polygon);
    const PolygonSolidAngle<double, 4> base(polygon);
    const Vec2<double> u{0.3, 0.8};
    EXPECT_NEAR(technique.sample(u).pdf, base.sample(u).pdf, 1e-14);
    EXPECT_LE(length(technique.sample(u).wi - base.sample(u).wi), 1e-14);
    // The same light, beginning at that vertex.
    const Corners turned = {light[2], light[3], light[0], light[1]};
    EXPECT_GT(deviation_of_polygon<PolygonBilinearWarpHart>(light),
              1.5 * deviation_of_polygon<PolygonBilinearWarpHart>(turned));
}

TEST(PolygonWarpHart, DependsOnTheFirstVertex) {
    // A failure of the method: the variance of the same clipped light differs.
    const Corners light = polygons()[5];
    const Corners turned = {light[2], light[3], light[0], light[1]};
    EXPECT_GT(deviation_of_polygon<PolygonClippedBilinearWarpHart>(light),
              1.3 * deviation_of_polygon<PolygonClippedBilinearWarpHart>(turned));
    EXPECT_GT(deviation_of_polygon<PolygonClippedBiquadraticWarpHart>(light),
              1.4 * deviation_of_polygon<PolygonClippedBiquadraticWarpHart>(turned));
    EXPECT_NEAR(deviation_of_polygon<PolygonClippedSolidAngle>(light),
                deviation_of_polygon<PolygonClippedSolidAngle>(turned), 0.01);
}

TEST(PolygonWarpHart, JumpsWhereClippingBegins) {
    // A failure of the method: a light whose first vertex crosses the horizon.
    const auto light = [](double z) {
        return Corners{{1, -0.5, z}, {1, 0.5, 0.5}, {1, 0.25, 1.25}, {1, -0.75, 0.75}};
    };
    const double above = deviation_of_polygon<PolygonClippedBilinearWarpHart>(light(1e-6));
    const double below = deviation_of_polygon<PolygonClippedBilinearWarpHart>(light(-1e-6));
    EXPECT_GT(std::max(above, below), 1.1 * std::min(above, below)) << above << " " << below;
    EXPECT_NEAR(deviation_of_polygon<PolygonClippedSolidAngle>(light(1e-6)),
                deviation_of_polygon<PolygonClippedSolidAngle>(light(-1e-6)), 1e-3);
}

TEST(PolygonWarpHart, HasLargeWeightsNextToAFirstVertexOnTheHorizon) {
    // A failure of the method: the cosine grows with the square root of y there, the density with y.
    const auto weight = [](double y) {
        const auto light =
            OfPolygon<PolygonBilinearWarpHart, PolygonSolidAngle, 4>::make<double>(polygons()[4]);
        const auto s = PolygonBilinearWarpHart<double, 4>(light).sample({0.5, y});
        return s.wi.z / s.pdf / projected_solid_angle(light);
    };
    EXPECT_LT(weight(0.5), 2);
    EXPECT_GT(weight(1e-4), 4);
    // Where random numbers are 10^4 times smaller, weights are 10 times larger.
    EXPECT_NEAR(weight(1e-12) / weight(1e-8), 10, 0.1);
}

template <template <class> class Technique>
double deviation_of_line(const Corners& ends) {
    using Kind = OfLine<Technique, LineSolidAngle>;
    return moments<Technique<double>, Kind>(ends, 20000).deviation;
}

TEST(LineWarpHart, ReducesTheVariance) {
    for (const int i : {1, 2, 3}) {
        const Corners light = lines()[static_cast<std::size_t>(i)];
        const double base = deviation_of_line<LineClippedSolidAngle>(light);
        const double linear = deviation_of_line<LineClippedLinearWarpHart>(light);
        const double quadratic = deviation_of_line<LineClippedQuadraticWarpHart>(light);
        EXPECT_LT(linear, 0.9 * base) << i;
        EXPECT_LT(quadratic, 0.7 * linear) << i;
    }
}

TEST(LineWarpHart, FailsWhereTheMiddleIsHigh) {
    // Failures of the linear warp: the cosine is largest between the ends.
    const Corners ceiling = {{-8, 0.5, 1}, {12, 0.5, 1}};
    EXPECT_GT(deviation_of_line<LineLinearWarpHart>(ceiling), deviation_of_line<LineSolidAngle>(ceiling));
    const Corners rising = {{-1, 0.2, 0}, {3, 0.2, 0.8}};
    EXPECT_GT(deviation_of_line<LineLinearWarpHart>(rising), 1.4 * deviation_of_line<LineSolidAngle>(rising));
    EXPECT_LT(deviation_of_line<LineQuadraticWarpHart>(rising),
              0.5 * deviation_of_line<LineSolidAngle>(rising));
}

TEST(LineWarpHart, IsExactForVerticalLines) {
    // The cosine is linear in the random number of the base.
    EXPECT_LE(deviation_of_line<LineLinearWarpHart>(lines()[5]), 1e-6);
    EXPECT_LE(deviation_of_line<LineQuadraticWarpHart>(lines()[5]), 1e-6);
}

} // namespace

} // namespace nusselt::warp_test
