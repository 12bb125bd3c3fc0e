/// Tests of the clipping of scalar code against clip_to_horizon().

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>

#include <gtest/gtest.h>

#include <nusselt/geometry/clip_polygon.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>

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

TYPED_TEST(OutlineTest, HasTheVerticesThatClippingKeeps) {
    constexpr int kVertices = TypeParam::value;
    int clipped_lights = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto polygon = this->random_polygon({0.3f, 0.2f, 0.4f});
        const auto outline = nusselt::outline_above_horizon<kVertices + 1>(polygon);
        const auto clipped = nusselt::clip_to_horizon(polygon);
        ASSERT_LE(outline.count, kVertices + 1);
        int k = 0;
        Vec sum{0, 0, 0};
        for (int j = 0; j <= kVertices; ++j) {
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
        if (outline.count != kVertices) ++clipped_lights;
    }
    EXPECT_GT(clipped_lights, 100);
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

} // namespace
} // namespace nusselt_test
