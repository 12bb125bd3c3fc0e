/// Tests of lights whose boundary passes the zenith or touches the horizon within rounding. Noise then decides which
/// side the zenith is on and which edges are outer ones, but this must not change the measure.

#include <nusselt/sampling/polygon_projected_solid_angle.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace nusselt {
namespace {

using Exact = long double;
using Engine = std::mt19937_64;

double uniform(Engine& engine, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
}

/// The polygon that the floats of another one describe: its first vertex and its edges.
template <int N>
ConvexPolygon<Exact, N> widened(const ConvexPolygon<float, N>& light) {
    ConvexPolygon<Exact, N> exact;
    exact.vertex[0] = broadcast<Exact>(light.vertex[0]);
    for (int j = 0; j < N; ++j) exact.edge[j] = broadcast<Exact>(light.edge[j]);
    for (int j = 0; j + 1 < N; ++j) exact.vertex[j + 1] = exact.vertex[j] + exact.edge[j];
    exact.normal = normalize(doubled_area_normal(exact));
    return exact;
}

/// A light that is put into the wrong case loses much of its measure. The rounding errors of thin slivers, which
/// occur among the random lights, reach 2e-3.
constexpr double kTolerance = 1e-2;

/// Relative error of the measure in single precision; 0 for lights that are practically invisible.
template <int N>
double measure_error(const ConvexPolygon<float, N>& light) {
    const Exact exact = projected_solid_angle(widened(light));
    if (exact < 1e-3L) return 0;
    return static_cast<double>(std::fabs(PolygonProjectedSolidAngle<float, N>(light).measure() / exact - 1));
}

/// \param turns by how many places the vertices move on.
ConvexPolygon<float, 4> quadrilateral(const Vec3<double> (&exact)[4], int turns) {
    Vec3<float> vertices[4] = {};
    std::transform(exact, exact + 4, vertices, [](const Vec3<double>& v) { return broadcast<float>(v); });
    std::rotate(vertices, vertices + turns % 4, vertices + 4);
    return make_polygon<4>(vertices, 4);
}

ConvexPolygon<float, 4> parallelogram(const Vec3<double>& first, const Vec3<double>& a, const Vec3<double>& b,
                                      int turns = 0) {
    return quadrilateral({first, first + a, first + a + b, first + b}, turns);
}

/// An edge that passes the zenith at the given distance, in any azimuth.
ConvexPolygon<float, 4> edge_near_zenith(Engine& engine, double distance) {
    const double azimuth = uniform(engine, 0, 2 * std::numbers::pi);
    const Vec3<double> along{std::cos(azimuth), std::sin(azimuth), uniform(engine, -1, 1)};
    const Vec3<double> across{-std::sin(azimuth), std::cos(azimuth), uniform(engine, -1, 1)};
    const Vec3<double> closest{-distance * std::sin(azimuth), distance * std::cos(azimuth),
                               uniform(engine, 0.3, 1)};
    const Vec3<double> first = closest - uniform(engine, 0.1, 2) * along;
    return parallelogram(first, uniform(engine, 2.1, 4) * along, uniform(engine, -2, 2) * across);
}

TEST(Zenith, EdgesThatPassItKeepTheMeasure) {
    Engine engine(1);
    for (const double distance : {0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3})
        for (int i = 0; i < 20000; ++i)
            ASSERT_LT(measure_error(edge_near_zenith(engine, distance)), kTolerance)
                << distance << ", case " << i;
}

TEST(Zenith, VerticesCloseToItKeepTheMeasure) {
    Engine engine(2);
    for (const double distance : {0.0, 1e-8, 1e-7, 1e-6, 4e-6, 1e-5, 1e-4})
        for (int i = 0; i < 20000; ++i) {
            const auto any = [&] {
                return Vec3<double>{uniform(engine, -2, 2), uniform(engine, -2, 2), uniform(engine, -2, 2)};
            };
            const Vec3<double> first{distance * uniform(engine, -1, 1), distance * uniform(engine, -1, 1),
                                     uniform(engine, 0.3, 2)};
            ASSERT_LT(measure_error(parallelogram(first, any(), any(), i)), kTolerance)
                << distance << ", case " << i;
        }
}

// Above the highest corner, the plane of a warped light may be higher than all of the light.
TEST(Zenith, CornersOfWarpedLightsKeepTheMeasure) {
    Engine engine(4);
    for (const double warp : {1e-5, 1e-3, 1e-2})
        for (int i = 0; i < 20000; ++i) {
            const double azimuth = uniform(engine, 0, 2 * std::numbers::pi);
            const Vec3<double> a{std::cos(azimuth), std::sin(azimuth), uniform(engine, -0.7, 0)};
            const Vec3<double> b{-std::sin(azimuth), std::cos(azimuth), uniform(engine, -0.7, 0)};
            const Vec3<double> corner{0, 0, uniform(engine, 1.5, 2)};
            const Vec3<double> off{0, 0, uniform(engine, -warp, warp)};
            const auto light = quadrilateral({corner, corner + a, corner + a + b + off, corner + b}, i);
            ASSERT_LT(measure_error(light), kTolerance) << warp << ", case " << i;
        }
}

// The light stands on the ground on one corner and leans over the point.
TEST(Horizon, VerticesOnItKeepTheMeasure) {
    Engine engine(3);
    int central = 0;
    for (int i = 0; i < 100000; ++i) {
        const double azimuth = uniform(engine, 0, 2 * std::numbers::pi);
        Vec3<float> v[3] = {
            {static_cast<float>(std::cos(azimuth)), static_cast<float>(std::sin(azimuth)), 0}, {}, {}};
        for (int j = 1; j < 3; ++j)
            v[j] = {static_cast<float>(uniform(engine, -2, 2)), static_cast<float>(uniform(engine, -2, 2)),
                    static_cast<float>(uniform(engine, 0.1, 2))};
        const auto light = make_polygon<3>(v, 3);
        const auto n = [&](int j) { return cross(light.vertex[j], light.edge[j]).z; };
        central += (n(0) > 0 && n(1) > 0 && n(2) > 0) || (n(0) < 0 && n(1) < 0 && n(2) < 0);
        ASSERT_LT(measure_error(light), kTolerance) << "case " << i;
    }
    EXPECT_GT(central, 5000);
}

} // namespace
} // namespace nusselt
