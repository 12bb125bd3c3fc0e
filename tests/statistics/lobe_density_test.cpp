/// Tests the densities of samples of lobes: the mean of a function divided by the density must be its integral.

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/adaptive_quadrature.h"
#include "hypothesis.h"
#include "sampling/lights.h"
#include "sampling/lit_part.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 20'000;

template <class Kind>
using Light = typename Kind::template Light<float>;
template <class Kind>
using Technique = typename Kind::template Technique<float>;
using Direction = nusselt::Vec3<float>;

/// The lobe times a factor that varies by a small ratio, so the estimate has some variance, but little. It contains
/// the lobe because the density vanishes where the lobe does.
long double integrand(const ReferenceLobe& lobe, const Point& wi) {
    return lobe.density(wi) * (2 + wi.x + 0.5L * wi.y);
}

/// Whether estimates with a density disagree with integrals.
/// \param density function of (technique, light, wi).
template <class Kind, class Density>
bool density_is_rejected(const Density& density) {
    UniformFloats random(9);
    return reject(cases<Kind>(), [&](const auto& light) {
        const Light<Kind> local = light_for<Kind, float>(light);
        const ReferenceLobe lobe(local.lobe);
        const auto f = [&](const Point& wi) { return integrand(lobe, wi); };
        long double expected = 0;
        if constexpr (kIsPolygon<Kind>) {
            expected = integrate_solid_angle(lit_part<Kind>(local), f, 1e-9L);
        } else {
            expected = integrate_per_radius(lit_part<Kind>(local), f);
        }
        const Technique<Kind> technique(local);
        MeanTest test;
        for (int i = 0; i < kSamples; ++i) {
            const float x = random();
            const auto sample = technique.sample(random_of<Kind>(x, random()));
            if (sample.pdf <= 0) continue;
            test.add(f(nusselt::broadcast<long double>(sample.wi)) / density(technique, local, sample.wi));
        }
        // The values for small lights hardly vary. The slack keeps rounding in float from counting as bias.
        return test.p_value(kSamples, expected, 1e-12L);
    });
}

template <class Kind>
class LobeDensityTest : public ::testing::Test {};

using Types =
    Instances<TestedBy<StatisticsSuite, PolygonOnLobeKinds<4>, PolygonOnLobeKinds<8>, LineOnLobeKinds>,
              float>;
TYPED_TEST_SUITE(LobeDensityTest, Types, InstanceNames);

TYPED_TEST(LobeDensityTest, MakesEstimatesUnbiased) {
    EXPECT_FALSE(density_is_rejected<typename TypeParam::Kind>(
        [](const auto& technique, const auto&, const Direction& wi) { return technique.pdf(wi); }));
}

TYPED_TEST(LobeDensityTest, WithoutTheChangeOfSolidAngleIsRejected) {
    EXPECT_TRUE(density_is_rejected<typename TypeParam::Kind>(
        [](const auto& technique, const auto& light, const Direction& wi) {
            const ReferenceLobe lobe(light.lobe);
            const long double r = length(lobe.image(nusselt::broadcast<long double>(wi)));
            return technique.pdf(wi) * (r * r * r) / lobe.determinant();
        }));
}

TEST(LobeDensityMutantsTest, WithoutTheChangeOfRadiusIsRejected) {
    EXPECT_TRUE(
        density_is_rejected<LineLtcKind>([](const auto& technique, const auto& light, const Direction& wi) {
            const nusselt::Ltc<float> ltc(light.lobe);
            return technique.pdf(wi) / nusselt::radius_ratio(cross(light.p0, light.s), ltc);
        }));
}

TEST(LobeDensityMutantsTest, OffByATenthOfAPercentIsRejected) {
    EXPECT_TRUE(density_is_rejected<PolygonLtcKind>(
        [](const auto& technique, const auto&, const Direction& wi) { return 1.001L * technique.pdf(wi); }));
}

} // namespace
} // namespace nusselt_test
