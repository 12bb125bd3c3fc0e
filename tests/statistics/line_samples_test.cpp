/// Tests samples of lines: their exact cumulative distribution function must map them to uniform numbers.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/reference.h"
#include "hypothesis.h"
#include "sampling/lights.h"
#include "sampling/lit_part.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 100'000;

template <class Kind>
using Light = typename Kind::template Light<float>;

/// The space in which a technique works: cosine space if it has a lobe.
template <class Kind>
class Image {
public:
    explicit Image(const Light<Kind>& light) : lobe_(lobe_of(light)) {}
    Point operator()(const Point& v) const { return lobe_.image(v); }

private:
    static ReferenceLobe lobe_of([[maybe_unused]] const Light<Kind>& light) {
        if constexpr (kHasLobe<Kind>) {
            return ReferenceLobe(light.lobe);
        } else {
            return ReferenceLobe(nusselt::LtcCoefficients<float>{1, 0, 1, 0, 1, 1});
        }
    }

    ReferenceLobe lobe_;
};

/// Integral of a measure along a line as a function of the angle from its closest point, by the textbook formulas
/// (Peters 2021, linear lights, Eq. 1 to 3).
template <class Kind>
class Distribution {
public:
    explicit Distribution(const Light<Kind>& light) : image_(light) {
        const Segment part = lit_part<Kind>(light);
        const Point begin = image_(part.begin);
        const Point end = image_(part.end);
        s_ = normalize(end - begin);
        const Point closest = begin - dot(begin, s_) * s_;
        distance_ = length(closest);
        t_ = normalize(closest);
        low_ = integral_to(begin);
        high_ = integral_to(end);
    }

    /// The share of the line before a direction.
    double operator()(const nusselt::Vec3<float>& wi) const {
        const long double value = integral_to(image_(nusselt::broadcast<long double>(wi)));
        return static_cast<double>((value - low_) / (high_ - low_));
    }

private:
    long double integral_to(const Point& direction) const {
        const long double angle = std::atan2(dot(direction, s_), dot(direction, t_));
        if constexpr (Kind::kMeasure == Measure::area) {
            return distance_ * std::tan(angle);
        } else if constexpr (Kind::kMeasure == Measure::solid_angle) {
            return std::sin(angle);
        } else {
            const long double sine = std::sin(angle);
            return s_.z * sine * sine + t_.z * (sine * std::cos(angle) + angle);
        }
    }

    Image<Kind> image_;
    Point s_, t_;
    long double distance_, low_, high_;
};

/// Whether samples of many lights disagree with the measure of a technique.
/// \tparam Kind the technique that the sampler claims to be.
/// \param make_sampler maps a light to a function from random numbers to directions.
template <class Kind, class MakeSampler>
bool samples_are_rejected(const MakeSampler& make_sampler) {
    UniformFloats random(8);
    return reject(cases<Kind>(), [&](const auto& light) {
        const auto local = light_for<Kind, float>(light);
        const Distribution<Kind> distribution(local);
        const auto sampler = make_sampler(local);
        std::vector<double> values(kSamples);
        for (double& value : values) value = distribution(sampler(random()));
        return kolmogorov_smirnov_test(values);
    });
}

template <class Kind>
auto sampler_of(const Light<Kind>& light) {
    return [technique = typename Kind::template Technique<float>(light)](float u) {
        return technique.sample(u).wi;
    };
}

/// A sampler whose random number is not uniform.
template <class Kind>
auto squaring_sampler_of(const Light<Kind>& light) {
    return [technique = typename Kind::template Technique<float>(light)](float u) {
        return technique.sample(u * u).wi;
    };
}

/// A sampler that returns the initialisation of the iteration.
auto starting_sampler_of(const nusselt::LineSegment<float>& light) {
    return [technique = nusselt::LineProjectedSolidAngle<float, 0>(light)](float u) {
        return technique.sample(u).wi;
    };
}

template <class Kind>
class LineSamplesTest : public ::testing::Test {};

using Types = Instances<TestedBy<StatisticsSuite, LineKinds, LineOnLobeKinds>, float>;
TYPED_TEST_SUITE(LineSamplesTest, Types, InstanceNames);

TYPED_TEST(LineSamplesTest, FollowTheirMeasure) {
    EXPECT_FALSE(samples_are_rejected<typename TypeParam::Kind>(sampler_of<typename TypeParam::Kind>));
}

TYPED_TEST(LineSamplesTest, SquaredRandomNumberIsRejected) {
    EXPECT_TRUE(
        samples_are_rejected<typename TypeParam::Kind>(squaring_sampler_of<typename TypeParam::Kind>));
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

TEST(LineMutantsTest, ProjectedSolidAnglePosingAsLobeIsRejected) {
    EXPECT_TRUE(samples_are_rejected<LineLtcKind>(sampler_of<LineProjectedSolidAngleKind>));
}

TEST(LineMutantsTest, UnclippedLobePosingAsClippedIsRejected) {
    EXPECT_TRUE(samples_are_rejected<LineClippedLtcKind>(sampler_of<LineLtcKind>));
}

} // namespace
} // namespace nusselt_test
