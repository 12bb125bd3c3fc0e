/// Samples of lines: their exact cumulative distribution makes them uniform.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/reference.h"
#include "hypothesis.h"
#include "sampling/lights.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 100'000;

using Light = nusselt::LineSegment<float>;

/// Integral of a measure along a line, as a function of the angle from its closest point: the textbook forms
/// (Peters 2021, linear lights, Eq. 1 to 3).
template <class Kind>
class Distribution {
public:
    explicit Distribution(const Light& light) {
        Point begin = widened_begin(light);
        Point end = widened_end(light);
        s_ = normalize(end - begin);
        const Point closest = begin - dot(begin, s_) * s_;
        distance_ = length(closest);
        t_ = normalize(closest);
        if (Kind::kHorizon == Horizon::kClipped) {
            const Point crossing = begin + (begin.z / (begin.z - end.z)) * (end - begin);
            if (begin.z < 0) begin = crossing;
            if (end.z < 0) end = crossing;
        }
        low_ = integral_to(begin);
        high_ = integral_to(end);
    }

    /// The share of the line before a direction.
    double operator()(const nusselt::Vec3<float>& wi) const {
        const long double value = integral_to(nusselt::broadcast<long double>(wi));
        return static_cast<double>((value - low_) / (high_ - low_));
    }

private:
    long double integral_to(const Point& direction) const {
        const long double angle = std::atan2(dot(direction, s_), dot(direction, t_));
        if constexpr (Kind::kMeasure == Measure::kArea) {
            return distance_ * std::tan(angle);
        } else if constexpr (Kind::kMeasure == Measure::kSolidAngle) {
            return std::sin(angle);
        } else {
            const long double sine = std::sin(angle);
            return s_.z * sine * sine + t_.z * (sine * std::cos(angle) + angle);
        }
    }

    Point s_, t_;
    long double distance_, low_, high_;
};

/// Whether samples of many lights disagree with the measure of a technique.
/// \tparam Kind the technique that the sampler claims to be.
/// \param  make_sampler makes from a light the function from random numbers to directions.
template <class Kind, class MakeSampler>
bool samples_are_rejected(const MakeSampler& make_sampler) {
    std::vector<double> p_values;
    UniformFloats random(8);
    for (const LineCase& light : line_cases()) {
        const auto local = make_light<float>(light);
        const Distribution<Kind> distribution(local);
        const auto sampler = make_sampler(local);
        std::vector<double> values(kSamples);
        for (double& value : values) value = distribution(sampler(random()));
        p_values.push_back(kolmogorov_smirnov_test(values));
    }
    return reject(p_values);
}

template <class Kind>
auto sampler_of(const Light& light) {
    return [technique = typename Kind::template Technique<float>(light)](float u) {
        return technique.sample(u).wi;
    };
}

/// A sampler whose random number is not uniform.
template <class Kind>
auto squaring_sampler_of(const Light& light) {
    return [technique = typename Kind::template Technique<float>(light)](float u) {
        return technique.sample(u * u).wi;
    };
}

/// A sampler that stops before the iteration.
auto starting_sampler_of(const Light& light) {
    return [technique = nusselt::LineProjectedSolidAngle<float, 0>(light)](float u) {
        return technique.sample(u).wi;
    };
}

template <class Kind>
class LineSamplesTest : public ::testing::Test {};

using Kinds = ::testing::Types<LineAreaKind, LineSolidAngleKind, LineClippedSolidAngleKind,
                               LineProjectedSolidAngleKind>;
TYPED_TEST_SUITE(LineSamplesTest, Kinds);

TYPED_TEST(LineSamplesTest, FollowTheirMeasure) {
    EXPECT_FALSE(samples_are_rejected<TypeParam>(sampler_of<TypeParam>));
}

TYPED_TEST(LineSamplesTest, SquaredRandomNumberIsRejected) {
    EXPECT_TRUE(samples_are_rejected<TypeParam>(squaring_sampler_of<TypeParam>));
}

TEST(LineMutantsTest, AreaPosingAsSolidAngleIsRejected) {
    EXPECT_TRUE(samples_are_rejected<LineSolidAngleKind>(sampler_of<LineAreaKind>));
}

TEST(LineMutantsTest, SolidAnglePosingAsAreaIsRejected) {
    EXPECT_TRUE(samples_are_rejected<LineAreaKind>(sampler_of<LineSolidAngleKind>));
}

TEST(LineMutantsTest, UnclippedPosingAsClippedIsRejected) {
    EXPECT_TRUE(samples_are_rejected<LineClippedSolidAngleKind>(sampler_of<LineSolidAngleKind>));
}

TEST(LineMutantsTest, SolidAnglePosingAsProjectedSolidAngleIsRejected) {
    EXPECT_TRUE(samples_are_rejected<LineProjectedSolidAngleKind>(sampler_of<LineClippedSolidAngleKind>));
}

TEST(LineMutantsTest, StartOfTheIterationPosingAsProjectedSolidAngleIsRejected) {
    EXPECT_TRUE(samples_are_rejected<LineProjectedSolidAngleKind>(starting_sampler_of));
}

} // namespace
} // namespace nusselt_test
