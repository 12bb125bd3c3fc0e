/// Tests of the clipping of scalar code against clip_to_horizon().

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>

#include <gtest/gtest.h>

#include <nusselt/geometry/clip_polygon.h>
#include <nusselt/geometry/outline.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/simd/pack.h>

namespace nusselt_test {
namespace {

using Vec = nusselt::Vec3<float>;

template <class Count>
class OutlineTest : public ::testing::Test {
protected:
    static constexpr int kCount = Count::value;
    using Polygon = nusselt::ConvexPolygon<float, kCount>;

    /// A regular polygon of radius 1 around a centre, in a plane of random orientation.
    Polygon random_polygon(const Vec& centre) {
        std::normal_distribution<float> normal;
        const auto direction = [&] {
            return nusselt::normalize(Vec{normal(engine_), normal(engine_), normal(engine_)});
        };
        const Vec a = direction();
        const Vec b = nusselt::normalize(nusselt::cross(a, direction()));
        Vec vertices[kCount];
        for (int j = 0; j < kCount; ++j) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(j) / kCount;
            vertices[j] = centre + std::cos(angle) * a + std::sin(angle) * b;
        }
        return nusselt::make_polygon<kCount>(vertices, kCount);
    }

    /// A horizontal polygon whose vertices are above and below the horizon in turns, as if by rounding.
    static Polygon jagged_polygon() {
        Vec vertices[kCount];
        for (int j = 0; j < kCount; ++j) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(j) / kCount;
            vertices[j] = {3 + std::cos(angle), std::sin(angle), j % 2 == 0 ? 1e-8f : -1e-8f};
        }
        return nusselt::make_polygon<kCount>(vertices, kCount);
    }

    std::mt19937 engine_{7};
};

template <int... Counts>
using Bounds = ::testing::Types<std::integral_constant<int, Counts>...>;
using Counts = Bounds<3, 4, 5, 6, 7, 8>;
TYPED_TEST_SUITE(OutlineTest, Counts);

/// Whether an outline has the vertices and edges of a clipped polygon, without its edges of length zero.
template <int Capacity, int M>
void expect_same(const nusselt::Outline<Capacity>& outline, const nusselt::ConvexPolygon<float, M>& clipped) {
    int k = 0;
    Vec sum{0, 0, 0};
    for (int j = 0; j < M; ++j) {
        const Vec& edge = clipped.edge[j];
        if (nusselt::dot(edge, edge) == 0) continue;
        ASSERT_LT(k, outline.count);
        const Vec apart = outline.vertex[k] - clipped.vertex[j];
        const Vec turned = outline.edge[k] - edge;
        EXPECT_LE(std::sqrt(nusselt::dot(apart, apart)), 1e-6f);
        EXPECT_LE(std::sqrt(nusselt::dot(turned, turned)), 1e-6f);
        sum += outline.edge[k];
        ++k;
    }
    EXPECT_EQ(k, outline.count);
    EXPECT_LE(std::sqrt(nusselt::dot(sum, sum)), 2e-6f);
}

TYPED_TEST(OutlineTest, HasTheVerticesThatClippingKeeps) {
    constexpr int kVertices = TypeParam::value;
    int clipped_lights = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto polygon = this->random_polygon({0.3f, 0.2f, 0.4f});
        const auto outline = nusselt::outline_above_horizon<kVertices + 1>(polygon);
        expect_same(outline, nusselt::clip_to_horizon(polygon));
        if (outline.count != kVertices) ++clipped_lights;
    }
    EXPECT_GT(clipped_lights, 100);
}

/// Vertices on the horizon, repeated vertices, unused slots and lights below the horizon, from every first vertex.
TYPED_TEST(OutlineTest, HasTheVerticesThatClippingKeepsOfDegenerateLights) {
    constexpr int kVertices = TypeParam::value;
    int clipped_lights = 0;
    int touching_lights = 0;
    std::uniform_int_distribution<int> index(0, kVertices - 1);
    for (int i = 0; i < 4000; ++i) {
        // An upright light whose heights are multiples of 1/4, so that vertices often lie on the horizon.
        const int count = std::max(3, index(this->engine_) + 1);
        const int first = index(this->engine_) % count;
        const float lowest =
            0.25f * static_cast<float>(std::uniform_int_distribution<int>(-8, 1)(this->engine_));
        Vec corners[kVertices];
        for (int j = 0; j < count; ++j) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>((j + first) % count) /
                                static_cast<float>(count);
            const float height = lowest + std::round(4 * (1 + std::sin(angle))) / 4;
            corners[j] = {std::cos(angle), 2, height};
        }
        // Repeat one of the vertices instead of another.
        Vec vertices[kVertices];
        const int repeated = index(this->engine_) % count;
        const int used = std::min(kVertices, count + i % 2);
        for (int j = 0; j < used; ++j) vertices[j] = corners[used > count && j > repeated ? j - 1 : j];
        const auto polygon = nusselt::make_polygon<kVertices>(vertices, used);
        const auto outline = nusselt::outline_above_horizon<kVertices + 1>(polygon);
        const auto clipped = nusselt::clip_to_horizon(polygon);
        float top = 0;
        bool touches = false;
        for (const Vec& v : polygon.vertex) {
            top = std::max(top, v.z);
            touches |= v.z == 0;
        }
        bool meets_horizon = false; // in more than a point
        for (int j = 0; j <= kVertices; ++j) {
            const Vec& edge = clipped.edge[j];
            meets_horizon |= clipped.vertex[j].z == 0 && edge.z == 0 && nusselt::dot(edge, edge) > 0;
        }
        if (top <= 0 || (touches && !meets_horizon)) {
            EXPECT_EQ(outline.count, 0);
            continue;
        }
        expect_same(outline, clipped);
        touching_lights += touches ? 1 : 0;
        clipped_lights += lowest < 0 ? 1 : 0;
    }
    EXPECT_GT(clipped_lights, 1000);
    EXPECT_GT(touching_lights, 300);
}

TYPED_TEST(OutlineTest, LeavesBoundariesThatCrossTheHorizonSeveralTimesToTheGeneralCase) {
    constexpr int kVertices = TypeParam::value;
    const auto polygon = this->jagged_polygon();
    const auto outline = nusselt::outline_above_horizon<kVertices + 1>(polygon);
    if (kVertices >= 4)
        EXPECT_EQ(outline.count, 0);
    else
        EXPECT_LE(outline.count, kVertices + 1);
    const nusselt::PolygonProjectedSolidAngle<float, kVertices> technique(polygon);
    EXPECT_GE(technique.measure(), 0);
    EXPECT_LE(technique.measure(), nusselt::kPi<float>);
}

/// With all numbers of vertices, so that each number of lanes has its turn. Packs go through clip_to_horizon().
TYPED_TEST(OutlineTest, LightsThatTheHorizonCutsMeasureTheSameInScalarsAndPacks) {
    constexpr int kVertices = TypeParam::value;
    using Real = nusselt::Pack<float, 4>;
    for (int i = 0; i < 2000; ++i) {
        const auto polygon = this->random_polygon({1.5f, 0.2f, 0.4f});
        const nusselt::PolygonProjectedSolidAngle<float, kVertices> scalar(polygon);
        const nusselt::PolygonProjectedSolidAngle<Real, kVertices> packed(nusselt::broadcast<Real>(polygon));
        // Rounding relative to the whole light, of which little may be above the horizon or visible.
        EXPECT_NEAR(scalar.measure(), packed.measure().lane(0), 1e-5f * scalar.measure() + 1e-6f);
        const nusselt::Vec2<float> u{0.3f, 0.6f};
        const auto a = scalar.sample(u).wi;
        const auto b = packed.sample({Real(u.x), Real(u.y)}).wi;
        const Vec turned = a - Vec{b.x.lane(0), b.y.lane(0), b.z.lane(0)};
        EXPECT_LE(std::sqrt(nusselt::dot(turned, turned)), 1e-4f) << "measure " << scalar.measure();
    }
}

} // namespace
} // namespace nusselt_test
