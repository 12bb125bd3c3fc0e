/// Tests samples of cylinders and their densities: the mean of a function divided by the density must be its
/// integral, which comes from quadrature over the surface.

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/cylinder_reference.h"
#include "hypothesis.h"
#include "ltc/reference.h"
#include "sampling/lights.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 20'000;

template <class Kind>
using Light = typename Kind::template Light<float>;
template <class Kind>
using Technique = typename Kind::template Technique<float>;
using Random = nusselt::Vec2<float>;
using Sample = nusselt::LightSample<float>;

/// The function on whose support a density must be positive, times factors that vary by a small ratio. Estimates thus
/// have some variance, but little.
template <class Kind>
auto integrand(const Light<Kind>& light) {
    const auto importance = [light](const Point& wi) {
        if constexpr (Kind::kMeasure == Measure::lobe) return ReferenceLobe(light.lobe).density(wi);
        return Kind::kMeasure == Measure::projected_solid_angle ? std::max(wi.z, 0.0L) : 1.0L;
    };
    const Point s = solid(light).axis();
    return [importance, s](const Point& wi) {
        return importance(wi) * (2 + wi.x + 0.5L * wi.y) * (1.5L + dot(s, wi));
    };
}

/// Whether estimates with samples and densities disagree with integrals.
/// \param warp    maps random numbers that should be uniform.
/// \param density function of (technique, sample).
template <class Kind, class Warp, class Density>
bool is_rejected(const Warp& warp, const Density& density) {
    UniformFloats random(10);
    return reject(cases<Kind>(), [&](const auto& light) {
        const Light<Kind> local = light_for<Kind, float>(light);
        const auto f = integrand<Kind>(local);
        const Technique<Kind> technique(local);
        const long double expected = integrate_solid_angle(solid(local), f, 1e-5L * technique.measure());
        MeanTest test;
        for (int i = 0; i < kSamples; ++i) {
            const float x = random();
            const auto sample = technique.sample(warp({x, random()}));
            if (!(sample.pdf > 0)) continue;
            test.add(f(nusselt::broadcast<long double>(sample.wi)) / density(technique, sample));
        }
        // The values for small lights hardly vary. The slack keeps rounding in float and the tolerance of the
        // integral from counting as bias.
        return test.p_value(kSamples, expected, 1e-9L);
    });
}

Random unwarped(const Random& u) { return u; }

/// Tests of the contract compare it with pdf(wi). For areas, that one may round to a direction that misses the light.
constexpr auto kOwnDensity = [](const auto&, const Sample& sample) { return sample.pdf; };

template <class Kind>
class CylinderSamplesTest : public ::testing::Test {};

using Types = Instances<TestedBy<StatisticsSuite, CylinderKinds, CylinderOnLobeKinds>, float>;
TYPED_TEST_SUITE(CylinderSamplesTest, Types, InstanceNames);

TYPED_TEST(CylinderSamplesTest, FollowTheirDensity) {
    EXPECT_FALSE(is_rejected<typename TypeParam::Kind>(unwarped, kOwnDensity));
}

TYPED_TEST(CylinderSamplesTest, SquaredRandomNumbersAreRejected) {
    EXPECT_TRUE(is_rejected<typename TypeParam::Kind>(
        [](const Random& u) {
            return Random{u.x * u.x, u.y};
        },
        kOwnDensity));
    EXPECT_TRUE(is_rejected<typename TypeParam::Kind>(
        [](const Random& u) {
            return Random{u.x, u.y * u.y};
        },
        kOwnDensity));
}

TEST(CylinderMutantsTest, DensityWithoutTheAzimuthIsRejected) {
    // This density would be correct if the interpolant were exact.
    EXPECT_TRUE(is_rejected<CylinderProjectedSolidAngleKind>(
        unwarped,
        [](const auto& technique, const Sample& sample) { return sample.wi.z / technique.measure(); }));
    EXPECT_TRUE(is_rejected<CylinderSolidAngleKind>(
        unwarped, [](const auto& technique, const Sample&) { return 1 / technique.measure(); }));
}

} // namespace
} // namespace nusselt_test
