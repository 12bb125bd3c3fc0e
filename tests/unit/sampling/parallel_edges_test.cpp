/// Lights with edges parallel to the normal of the surface, as in most rooms: in the shading frame, the ends of such
/// an edge have the same azimuth up to rounding, so they may sort the wrong way round.

#include <nusselt/sampling/polygon_projected_solid_angle.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nusselt {
namespace {

using Exact = long double;

struct Case {
    ConvexPolygon<float, 4> rounded;
    ConvexPolygon<Exact, 4> exact;
};

/// A rectangle with two sides parallel to a random normal, rotated into the shading frame in single
/// precision.
Case random_case(std::mt19937_64& engine) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto random_direction = [&] {
        return normalize(Vec3<double>{normal(engine), normal(engine), normal(engine)});
    };
    const Vec3<double> n = random_direction();
    const Vec3<double> side = normalize(cross(n, random_direction()));
    const Vec3<double> first = 2 * uniform(engine) * random_direction() + 0.3 * n;
    const auto frame = Frame<float>::from_normal(broadcast<float>(n));
    const Vec3<float> up = frame.to_local(broadcast<float>((0.2 + uniform(engine)) * n));
    const Vec3<float> along = frame.to_local(broadcast<float>((0.2 + uniform(engine)) * side));
    const Vec3<float> edges[4] = {up, along, -up, -along};

    Case result;
    result.rounded.vertex[0] = frame.to_local(broadcast<float>(first));
    result.exact.vertex[0] = broadcast<Exact>(result.rounded.vertex[0]);
    for (int j = 0; j < 4; ++j) {
        result.rounded.edge[j] = edges[j];
        result.exact.edge[j] = broadcast<Exact>(edges[j]);
        if (j == 3) break;
        result.rounded.vertex[j + 1] = result.rounded.vertex[j] + edges[j];
        result.exact.vertex[j + 1] = result.exact.vertex[j] + result.exact.edge[j];
    }
    result.rounded.normal = normalize(doubled_area_normal(result.rounded));
    result.exact.normal = normalize(doubled_area_normal(result.exact));
    return result;
}

// A wrong order causes an error as large as the measure itself. The test leaves out slivers, whose rounding errors
// are a few per cent.
TEST(ParallelEdges, KeepTheProjectedSolidAngle) {
    std::mt19937_64 engine(1);
    int lit = 0;
    for (int i = 0; i < 200000; ++i) {
        const Case c = random_case(engine);
        const Exact exact = projected_solid_angle(c.exact);
        if (exact < 1e-3L) continue;
        ++lit;
        const PolygonProjectedSolidAngle<float, 4> technique(c.rounded);
        ASSERT_NEAR(static_cast<double>(technique.measure() / exact), 1, 2e-3) << "case " << i;
    }
    EXPECT_GT(lit, 50000);
}

} // namespace
} // namespace nusselt
