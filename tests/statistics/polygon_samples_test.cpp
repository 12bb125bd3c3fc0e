/// Counts samples of polygons in cells whose area, solid angle or projected solid angle is known exactly.

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/reference.h"
#include "hypothesis.h"
#include "sampling/lights.h"
#include "sampling/lit_part.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 100'000;
constexpr int kCellsPerAxis = 8;
/// Share of the extent of a light by which rounding may move directions beyond an edge: float resolves the position on
/// the most grazing light of the list to 4e-6 of its extent.
constexpr long double kSlack = 1e-4L;

template <class Kind>
using Light = typename Kind::template Light<float>;
using Random = nusselt::Vec2<float>;

/// A regular grid in the plane of a light, over the bounding box of the light. Seen from the point, the grid lines
/// are great circles, so the part of the light in each cell is a polygon.
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

    /// The share of each cell in the measure of the light, times the number of samples. The last cell is outside the
    /// light.
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
        counts.push_back(0);
        return counts;
    }

    static constexpr std::size_t kOutside = kCellsPerAxis * kCellsPerAxis;

    std::size_t index(const nusselt::Vec3<float>& wi) const {
        const Point direction = nusselt::broadcast<long double>(wi);
        if (!(dot(towards_plane_, direction) > 0)) return kOutside; // also for NaN
        const auto c = coordinates(direction);
        if (!is_on_light(c)) return kOutside;
        return axis_index(c.y, low_.y, high_.y) * kCellsPerAxis + axis_index(c.x, low_.x, high_.x);
    }

private:
    nusselt::Vec2<long double> coordinates(const Point& direction) const {
        const Point p = (1 / dot(towards_plane_, direction)) * direction;
        return {dot(u_, p), dot(v_, p)};
    }
    bool is_on_light(const nusselt::Vec2<long double>& c) const {
        const long double slack = kSlack * std::max(high_.x - low_.x, high_.y - low_.y);
        for (std::size_t j = 0; j < light_.size(); ++j) {
            const auto a = coordinates(light_[j]);
            const auto b = coordinates(light_[(j + 1) % light_.size()]);
            // The axes are chosen so that the light is counterclockwise.
            const long double doubled_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            if (!(doubled_area >= -slack * std::hypot(b.x - a.x, b.y - a.y))) return false;
        }
        return true;
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
    Point towards_plane_; ///< its dot product with each point of the plane is 1
    Point u_, v_;
    nusselt::Vec2<long double> low_, high_;
};

/// The measure of a part of a light.
template <class Kind>
long double measure_of([[maybe_unused]] const Light<Kind>& light, const Polygon& polygon) {
    if constexpr (kHasLobe<Kind>) {
        return ReferenceLobe(light.lobe).integral(polygon);
    } else if constexpr (Kind::kMeasure == Measure::area) {
        return integrate(
            polygon, [](const Point&) { return 1.0L; }, 1);
    } else if constexpr (Kind::kMeasure == Measure::solid_angle) {
        return girard(polygon);
    } else {
        return lambert(polygon);
    }
}

/// Whether samples of many lights disagree with the measure of a technique.
/// \tparam Kind the technique that the sampler claims to be.
/// \param make_sampler maps a light to a function from random numbers to directions.
template <class Kind, class MakeSampler>
bool samples_are_rejected(const MakeSampler& make_sampler) {
    UniformFloats random(7);
    return reject(cases<Kind>(), [&](const auto& light) {
        const auto local = light_for<Kind, float>(light);
        const Cells cells(lit_part<Kind>(local));
        const auto measure = [&](const Polygon& cell) { return measure_of<Kind>(local, cell); };
        const auto sampler = make_sampler(local);
        std::vector<std::int64_t> observed(Cells::kOutside + 1);
        for (int i = 0; i < kSamples; ++i) {
            const float x = random();
            ++observed[cells.index(sampler(Random{x, random()}))];
        }
        return observed[Cells::kOutside] > 0 ? 0 : chi_square_test(cells.expected(measure), observed);
    });
}

template <class Kind>
auto sampler_of(const Light<Kind>& light) {
    return [technique = typename Kind::template Technique<float>(light)](const Random& u) {
        return technique.sample(u).wi;
    };
}

/// Two samplers with one random number that is not uniform, and one that samples the opposite directions.
template <class Kind>
auto squaring_x_sampler_of(const Light<Kind>& light) {
    return [sampler = sampler_of<Kind>(light)](const Random& u) { return sampler({u.x * u.x, u.y}); };
}
template <class Kind>
auto squaring_y_sampler_of(const Light<Kind>& light) {
    return [sampler = sampler_of<Kind>(light)](const Random& u) { return sampler({u.x, u.y * u.y}); };
}
template <class Kind>
auto opposite_sampler_of(const Light<Kind>& light) {
    return [sampler = sampler_of<Kind>(light)](const Random& u) { return -sampler(u); };
}

/// A sampler that is correct except that one sample in ten thousand is NaN.
template <class Kind>
auto failing_sampler_of(const Light<Kind>& light) {
    return [sampler = sampler_of<Kind>(light)](const Random& u) {
        const auto wi = sampler(u);
        return u.x < 1e-4f ? std::numeric_limits<float>::quiet_NaN() * wi : wi;
    };
}

template <class Kind>
class PolygonSamplesTest : public ::testing::Test {};

using Types = Instances<TestedBy<StatisticsSuite, PolygonKinds<4>, PolygonKinds<8>, RectangleKinds,
                                 PolygonOnLobeKinds<4>, PolygonOnLobeKinds<8>>,
                        float>;
TYPED_TEST_SUITE(PolygonSamplesTest, Types, InstanceNames);

TYPED_TEST(PolygonSamplesTest, FollowTheirMeasure) {
    EXPECT_FALSE(samples_are_rejected<typename TypeParam::Kind>(sampler_of<typename TypeParam::Kind>));
}

TYPED_TEST(PolygonSamplesTest, MutantsAreRejected) {
    EXPECT_TRUE(
        samples_are_rejected<typename TypeParam::Kind>(squaring_x_sampler_of<typename TypeParam::Kind>));
    EXPECT_TRUE(
        samples_are_rejected<typename TypeParam::Kind>(squaring_y_sampler_of<typename TypeParam::Kind>));
    EXPECT_TRUE(
        samples_are_rejected<typename TypeParam::Kind>(opposite_sampler_of<typename TypeParam::Kind>));
    EXPECT_TRUE(samples_are_rejected<typename TypeParam::Kind>(failing_sampler_of<typename TypeParam::Kind>));
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
    EXPECT_TRUE(samples_are_rejected<PolygonProjectedSolidAngleKind>(
        sampler_of<PolygonProjectedSolidAngleBiasedKind>));
}

TEST(PolygonMutantsTest, ProjectedSolidAnglePosingAsLobeIsRejected) {
    EXPECT_TRUE(samples_are_rejected<PolygonLtcKind>(sampler_of<PolygonProjectedSolidAngleKind>));
}

TEST(PolygonMutantsTest, UnclippedLobePosingAsClippedIsRejected) {
    EXPECT_TRUE(samples_are_rejected<PolygonClippedLtcKind>(sampler_of<PolygonLtcKind>));
}

} // namespace
} // namespace nusselt_test
