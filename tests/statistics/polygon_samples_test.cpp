/// Samples of polygons, counted in cells whose area, solid angle or projected solid angle is known exactly.

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/reference.h"
#include "hypothesis.h"
#include "sampling/lights.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 100'000;
constexpr int kCellsPerAxis = 8;

using Light = nusselt::ConvexPolygon<float, 4>;
using Random = nusselt::Vec2<float>;

/// A regular grid in the plane of a light, over the bounding box of the light. The grid lines are great
/// circles for the point, so that the part of the light in each cell is a polygon.
class Cells {
public:
    explicit Cells(const Polygon& light) : light_(light) {
        const Point normal = normalize(cross(light[1] - light[0], light[2] - light[0]));
        towards_plane_ = (1 / dot(normal, light[0])) * normal;
        u_ = normalize(light[1] - light[0]);
        v_ = cross(normal, u_);
        low_ = high_ = coordinates(light[0]);
        for (const Point& p : light) {
            const auto c = coordinates(p);
            low_ = {std::min(low_.x, c.x), std::min(low_.y, c.y)};
            high_ = {std::max(high_.x, c.x), std::max(high_.y, c.y)};
        }
    }

    /// The share of each cell in a measure of polygons, times the number of samples.
    template <class MeasureFunction>
    std::vector<double> expected(const MeasureFunction& measure) const {
        std::vector<double> counts;
        const long double total = measure(light_);
        for (int j = 0; j < kCellsPerAxis; ++j) {
            for (int i = 0; i < kCellsPerAxis; ++i) {
                const Polygon row =
                    cut(cut(light_, beyond(v_, low_.y, high_.y, j)), -beyond(v_, low_.y, high_.y, j + 1));
                const Polygon cell =
                    cut(cut(row, beyond(u_, low_.x, high_.x, i)), -beyond(u_, low_.x, high_.x, i + 1));
                counts.push_back(cell.size() < 3 ? 0 : static_cast<double>(kSamples * measure(cell) / total));
            }
        }
        return counts;
    }

    std::size_t index(const nusselt::Vec3<float>& wi) const {
        const auto c = coordinates(nusselt::broadcast<long double>(wi));
        return axis_index(c.y, low_.y, high_.y) * kCellsPerAxis + axis_index(c.x, low_.x, high_.x);
    }

private:
    nusselt::Vec2<long double> coordinates(const Point& direction) const {
        const Point p = (1 / dot(towards_plane_, direction)) * direction;
        return {dot(u_, p), dot(v_, p)};
    }
    /// Normal of the great circle through a grid line.
    Point beyond(const Point& axis, long double low, long double high, int line) const {
        return axis - (low + (high - low) * line / kCellsPerAxis) * towards_plane_;
    }
    static std::size_t axis_index(long double x, long double low, long double high) {
        const long double cell = std::floor((x - low) / (high - low) * kCellsPerAxis);
        return static_cast<std::size_t>(std::clamp(cell, 0.0L, kCellsPerAxis - 1.0L));
    }

    Polygon light_;
    Point towards_plane_; ///< its product with each point of the plane is 1
    Point u_, v_;
    nusselt::Vec2<long double> low_, high_;
};

template <class Kind>
long double measure_of(const Polygon& polygon) {
    if constexpr (Kind::kMeasure == Measure::kArea) {
        return integrate(
            polygon, [](const Point&) { return 1.0L; }, 1);
    } else if constexpr (Kind::kMeasure == Measure::kSolidAngle) {
        return girard(polygon);
    } else {
        return lambert(polygon);
    }
}

/// Whether samples of many lights disagree with the measure of a technique.
/// \tparam Kind the technique that the sampler claims to be.
/// \param  make_sampler makes from a light the function from random numbers to directions.
template <class Kind, class MakeSampler>
bool samples_are_rejected(const MakeSampler& make_sampler) {
    std::vector<double> p_values;
    UniformFloats random(7);
    for (const PolygonCase& light : polygon_cases()) {
        const auto local = make_light<float>(light);
        const Polygon whole = vertices_of(local);
        const Cells cells(Kind::kHorizon == Horizon::kClipped ? above_horizon(whole) : whole);
        const auto sampler = make_sampler(local);
        std::vector<std::int64_t> observed(kCellsPerAxis * kCellsPerAxis);
        for (int i = 0; i < kSamples; ++i) {
            const float x = random();
            ++observed[cells.index(sampler(Random{x, random()}))];
        }
        p_values.push_back(chi_square_test(cells.expected(measure_of<Kind>), observed));
    }
    return reject(p_values);
}

template <class Kind>
auto sampler_of(const Light& light) {
    return [technique = typename Kind::template Technique<float>(light)](const Random& u) {
        return technique.sample(u).wi;
    };
}

/// A sampler whose first random number is not uniform.
template <class Kind>
auto squaring_sampler_of(const Light& light) {
    return [technique = typename Kind::template Technique<float>(light)](const Random& u) {
        return technique.sample({u.x * u.x, u.y}).wi;
    };
}

template <class Kind>
class PolygonSamplesTest : public ::testing::Test {};

using Kinds = ::testing::Types<PolygonAreaKind, PolygonSolidAngleKind, PolygonClippedSolidAngleKind,
                               PolygonProjectedSolidAngleKind>;
TYPED_TEST_SUITE(PolygonSamplesTest, Kinds);

TYPED_TEST(PolygonSamplesTest, FollowTheirMeasure) {
    EXPECT_FALSE(samples_are_rejected<TypeParam>(sampler_of<TypeParam>));
}

TYPED_TEST(PolygonSamplesTest, SquaredRandomNumberIsRejected) {
    EXPECT_TRUE(samples_are_rejected<TypeParam>(squaring_sampler_of<TypeParam>));
}

TEST(PolygonMutantsTest, AreaPosingAsSolidAngleIsRejected) {
    EXPECT_TRUE(samples_are_rejected<PolygonSolidAngleKind>(sampler_of<PolygonAreaKind>));
}

TEST(PolygonMutantsTest, SolidAnglePosingAsAreaIsRejected) {
    EXPECT_TRUE(samples_are_rejected<PolygonAreaKind>(sampler_of<PolygonSolidAngleKind>));
}

TEST(PolygonMutantsTest, UnclippedPosingAsClippedIsRejected) {
    EXPECT_TRUE(samples_are_rejected<PolygonClippedSolidAngleKind>(sampler_of<PolygonSolidAngleKind>));
}

TEST(PolygonMutantsTest, SolidAnglePosingAsProjectedSolidAngleIsRejected) {
    EXPECT_TRUE(
        samples_are_rejected<PolygonProjectedSolidAngleKind>(sampler_of<PolygonClippedSolidAngleKind>));
}

TEST(PolygonMutantsTest, BiasedVariantPosingAsUnbiasedIsRejected) {
    EXPECT_TRUE(samples_are_rejected<PolygonProjectedSolidAngleKind>(sampler_of<PolygonBiasedKind>));
}

} // namespace
} // namespace nusselt_test
