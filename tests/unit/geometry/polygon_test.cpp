/// Tests of polygons: construction, closed forms against quadrature and other closed forms, and clipping.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <nusselt/geometry/polygon_measures.h>

#include "geometry/reference.h"
#include "proof/hostile/lights.h"
#include "sampling/lights.h"

namespace nusselt_test {
namespace {

template <class T>
class PolygonTest : public ::testing::Test {
protected:
    static constexpr T kEpsilon = std::numeric_limits<T>::epsilon();
};

using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(PolygonTest, Scalars);

TYPED_TEST(PolygonTest, UnusedSlotsRepeatTheLastVertex) {
    using T = TypeParam;
    const nusselt::Vec3<T> v[] = {{1, 0, 1}, {2, 0, 1}, {2, 3, 1}};
    const auto polygon = nusselt::make_polygon<6>(v, 3);
    for (int j = 3; j < 6; ++j) EXPECT_EQ(length(polygon.vertex[j] - v[2]), 0);
    for (int j = 2; j < 5; ++j) EXPECT_EQ(length(polygon.edge[j]), 0);
    EXPECT_EQ(length(polygon.edge[5] - (v[0] - v[2])), 0);
    EXPECT_EQ(polygon.normal.z, 1);
    EXPECT_EQ(area(polygon), T(1.5));
}

TYPED_TEST(PolygonTest, NormalFollowsTheWinding) {
    using T = TypeParam;
    const nusselt::Vec3<T> v[] = {{1, 0, 1}, {2, 3, 1}, {2, 0, 1}};
    EXPECT_EQ((nusselt::make_polygon<4>(v, 3).normal.z), -1);
}

TYPED_TEST(PolygonTest, NoAreaNoNormal) {
    using T = TypeParam;
    const nusselt::Vec3<T> v[] = {{1, 1, 1}, {2, 2, 2}, {4, 4, 4}};
    const auto polygon = nusselt::make_polygon<4>(v, 3);
    EXPECT_EQ(length(polygon.normal), 0);
    EXPECT_EQ(area(polygon), 0);
}

TYPED_TEST(PolygonTest, ShadingSpaceKeepsSmallEdgesAtADistance) {
    using T = TypeParam;
    // For a light of one millimetre at a distance of about fifty metres, differences of rounded vertices would be
    // wrong by 0.4 %.
    const nusselt::Vec3<T> v[] = {{40, 30, 20}, {T(40.001), 30, 20}, {T(40.001), T(30.001), 20}};
    const auto world = nusselt::make_polygon<4>(v, 3);
    const auto frame = nusselt::Frame<T>::from_normal(normalize(nusselt::Vec3<T>{1, 2, 3}));
    const auto local = nusselt::to_shading_space(world, nusselt::Vec3<T>{T(0.1), T(0.2), T(0.3)}, frame);
    EXPECT_NEAR(area(local) / area(world), 1, 8 * this->kEpsilon);
    for (int j = 0; j < 4; ++j) {
        EXPECT_NEAR(length(local.edge[j]), length(world.edge[j]), 4 * this->kEpsilon * length(world.edge[j]));
    }
    EXPECT_NEAR(local.vertex[0].z, dot(frame.n, world.vertex[0] - nusselt::Vec3<T>{T(0.1), T(0.2), T(0.3)}),
                100 * this->kEpsilon);
}

TYPED_TEST(PolygonTest, RoundingIsNoEdgeAlongTheHorizon) {
    using T = TypeParam;
    // One vertex is so little below the horizon that the edge that closes the polygon would consist of the rounding
    // errors of the others.
    const T below = -this->kEpsilon / 8;
    const nusselt::Vec3<T> v[] = {
        {T(-0.3), T(0.2), below}, {T(1.1), T(-0.7), T(0.4)}, {T(-0.6), T(0.9), T(0.3)}};
    const auto clipped = clip_to_horizon(nusselt::make_polygon<3>(v, 3));
    int along_horizon = 0;
    for (int j = 0; j < 4; ++j) {
        if (clipped.vertex[j].z > 0 || clipped.vertex[(j + 1) % 4].z > 0) continue;
        ++along_horizon;
        EXPECT_EQ(length(clipped.edge[j]), 0);
        EXPECT_EQ(length(clipped.vertex[j] - clipped.vertex[(j + 1) % 4]), 0);
    }
    EXPECT_EQ(along_horizon, 1);
}

TYPED_TEST(PolygonTest, MeasuresAgreeWithReferences) {
    using T = TypeParam;
    for (const PolygonCase& light : polygon_cases()) {
        const auto polygon = make_light<T>(light);
        const Polygon vertices = vertices_of(polygon);
        const Polygon upper = above_horizon(vertices);
        // The error of Girard's formula in long double is absolute; for the small light, it amounts to a hundred
        // roundings.
        const T tolerance = std::max(200 * this->kEpsilon, T(4e-16));
        EXPECT_NEAR(area(polygon) / integrate(vertices, [](const Point&) { return 1.0L; }), 1, tolerance)
            << light.name;
        EXPECT_NEAR(solid_angle(polygon) / girard(vertices), 1, tolerance) << light.name;
        EXPECT_NEAR(solid_angle(clip_to_horizon(polygon)) / girard(upper), 1, tolerance) << light.name;
        EXPECT_NEAR(projected_solid_angle(polygon) / lambert(upper), 1, tolerance) << light.name;
    }
}

TEST(PolygonReferenceTest, ClosedFormsAgreeWithQuadrature) {
    for (const PolygonCase& light : polygon_cases()) {
        if (light.name == "large and close") continue; // beyond what a Gauss rule resolves
        const auto polygon = make_light<long double>(light);
        const Polygon upper = above_horizon(vertices_of(polygon));
        const long double plane = std::fabs(dot(polygon.normal, polygon.vertex[0]));
        const auto density = [&](const Point& p) { return plane / (length(p) * dot(p, p)); };
        EXPECT_NEAR(solid_angle(clip_to_horizon(polygon)) / integrate(upper, density), 1, 1e-12L)
            << light.name;
        const auto cosine_density = [&](const Point& p) { return density(p) * p.z / length(p); };
        EXPECT_NEAR(projected_solid_angle(polygon) / integrate(upper, cosine_density), 1, 1e-12L)
            << light.name;
    }
}

TYPED_TEST(PolygonTest, ClippedVerticesLieOnOrAboveTheHorizon) {
    using T = TypeParam;
    HostileLights<T> hostile(1);
    for (int i = 0; i < 20'000; ++i) {
        const auto polygon = hostile.polygon();
        int crossings = 0;
        bool above = false;
        bool below = false;
        for (int j = 0; j < 4; ++j) {
            above |= polygon.vertex[j].z > 0;
            below |= polygon.vertex[j].z < 0;
            crossings += (polygon.vertex[j].z > 0) != (polygon.vertex[(j + 1) % 4].z > 0);
        }
        if (crossings > 2) continue; // folded onto a line, vertices out of order
        const auto clipped = clip_to_horizon(polygon);
        nusselt::Vec3<T> sum{0, 0, 0};
        T extent = 0;
        T rounding = 0; // of an omitted edge along the horizon, see RoundingIsNoEdgeAlongTheHorizon
        int vertices_on_horizon = 0;
        for (int j = 0; j < 5; ++j) {
            EXPECT_GE(clipped.vertex[j].z, 0);
            vertices_on_horizon += clipped.vertex[j].z == 0;
            sum = sum + clipped.edge[j];
            extent = std::max(extent, length(polygon.edge[j % 4]));
            rounding += 4 * this->kEpsilon * length(clipped.edge[j]);
        }
        EXPECT_LE(length(sum), 8 * this->kEpsilon * extent + rounding);
        EXPECT_EQ(length(clipped.normal - polygon.normal), 0);
        // A polygon that crosses the horizon gets an edge along it.
        EXPECT_GE(vertices_on_horizon, above && below ? 2 : 0);
        if (above) continue;
        EXPECT_EQ(area(clipped), 0);
    }
}

TYPED_TEST(PolygonTest, EdgesOfClippedPolygonsConnectVertices) {
    using T = TypeParam;
    for (const PolygonCase& light : polygon_cases()) {
        const auto clipped = clip_to_horizon(make_light<T>(light));
        for (int j = 0; j < 5; ++j) {
            const auto difference = clipped.vertex[(j + 1) % 5] - clipped.vertex[j];
            EXPECT_LE(length(difference - clipped.edge[j]), 8 * this->kEpsilon * length(clipped.vertex[j]))
                << light.name << " edge " << j;
        }
    }
}

TYPED_TEST(PolygonTest, NothingIsSeenOfAPolygonFromItsPlane) {
    using T = TypeParam;
    // A degenerate triangle of the fan whose vertices lie in opposite directions would count as half the sphere.
    const nusselt::Vec3<T> around[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    const nusselt::Vec3<T> on_edge[] = {{-1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 1}};
    EXPECT_EQ(solid_angle(nusselt::make_polygon<4>(around, 4)), 0);
    EXPECT_EQ(solid_angle(nusselt::make_polygon<4>(on_edge, 4)), 0);
}

TYPED_TEST(PolygonTest, ClippingKeepsWhatIsAbove) {
    using T = TypeParam;
    const auto mirrored = [](PolygonCase light) {
        for (auto& v : light.vertices) v.z = -v.z;
        return light;
    };
    for (const PolygonCase& light : polygon_cases()) {
        const auto whole = make_light<T>(light);
        const auto upper = clip_to_horizon(whole);
        const auto lower = clip_to_horizon(make_light<T>(mirrored(light)));
        EXPECT_NEAR((area(upper) + area(lower)) / area(whole), 1, 200 * this->kEpsilon) << light.name;
        EXPECT_NEAR((solid_angle(upper) + solid_angle(lower)) / solid_angle(whole), 1, 200 * this->kEpsilon)
            << light.name;
    }
}

TYPED_TEST(PolygonTest, ClippingReturnsPolygonsAboveTheHorizon) {
    using T = TypeParam;
    const auto light = make_light<T>(polygon_cases().front());
    const auto clipped = clip_to_horizon(light);
    for (int j = 0; j < 4; ++j) EXPECT_EQ(length(clipped.vertex[j] - light.vertex[j]), 0);
    EXPECT_EQ(length(clipped.vertex[4] - light.vertex[3]), 0); // the additional slot repeats the last vertex
    EXPECT_EQ(length(clipped.edge[3]), 0);
    EXPECT_EQ(length(clipped.edge[4] - light.edge[3]), 0);
}

} // namespace
} // namespace nusselt_test
