/// Tests of the biased variants of projected solid angle sampling and lobe sampling: their errors are within the
/// documented bounds.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/estimate/backward_error.h>

#include "lights.h"
#include "proof/hostile/lights.h"

namespace nusselt_test {
namespace {

nusselt::ConvexPolygon<double, 4> random_quad(RandomSource& random) {
    const auto center = random.direction();
    const auto a = random.direction();
    const auto b = normalize(cross(a, random.direction()));
    const double size = random.log_between(0.1, 10);
    nusselt::Vec3<double> v[4] = {};
    for (int j = 0; j < 4; ++j) {
        const double angle = 6.283185307179586 * (j + 0.8 * random.uniform()) / 4;
        v[j] = center + (size * std::cos(angle)) * a + (size * std::sin(angle)) * b;
    }
    return nusselt::make_polygon<4>(v, 4);
}

/// The errors of five arctangents and of as many differences of them.
constexpr double kErrorOfMeasure = 10 * 1.3e-5;

/// Checks by how much a biased technique misses the random numbers of its samples, with one sample for each of many
/// lights.
/// \param next gives pairs of the exact and the biased technique for the same random light.
/// \param unit of measures, projected solid angle in cosine space.
template <class Next>
void expect_documented_errors(const Next& next, double unit) {
    RandomSource random(1);
    std::vector<double> errors;
    while (errors.size() < 20'000) {
        const auto [exact, biased] = next(random);
        if (exact.measure() < 1e-2 * unit) continue;
        EXPECT_NEAR(biased.measure(), exact.measure(), kErrorOfMeasure * unit);
        const nusselt::Vec2<double> u{random.uniform(), random.uniform()};
        const double error = nusselt::backward_error(exact, u, biased.sample(u).wi);
        errors.push_back(std::min(error, 1 - error)); // cyclic where the zenith is in the light
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(errors.back(), 0.28);
    EXPECT_LE(errors[errors.size() * 99 / 100], 0.1);
    // If the variant were exact, the technique under test would not be the biased one.
    EXPECT_GE(errors[errors.size() / 2], 1e-6);
}

TEST(BiasedTest, ErrorIsSmallButThere) {
    expect_documented_errors(
        [](RandomSource& random) {
            const auto light = random_quad(random);
            return std::pair{nusselt::PolygonProjectedSolidAngle<double, 4>(light),
                             nusselt::PolygonProjectedSolidAngleBiased<double, 4>(light)};
        },
        1);
}

TEST(BiasedTest, ErrorOfLobesIsSmallButThere) {
    for (const LobeCase& lobe : lobe_cases()) {
        const nusselt::Ltc<double> ltc(lobe.coefficients);
        expect_documented_errors(
            [&](RandomSource& random) {
                const auto light = random_quad(random);
                return std::pair{nusselt::PolygonLtc<double, 4>(light, ltc),
                                 nusselt::PolygonLtcBiased<double, 4>(light, ltc)};
            },
            1 / nusselt::kPi<double>);
    }
}

/// The density is that of the lobe, up to the errors of the arctangents in its normalisation. Samples are biased,
/// weights are not.
TEST(BiasedTest, DensityOfLobesIsAlmostExact) {
    RandomSource random(2);
    for (const auto& light : with_lobes(polygon_cases())) {
        const nusselt::Ltc<double> ltc(light.lobe);
        const nusselt::PolygonLtc<double, 4> exact(make_light<double>(light), ltc);
        const nusselt::PolygonLtcBiased<double, 4> biased(make_light<double>(light), ltc);
        EXPECT_NEAR(biased.measure(), exact.measure(), kErrorOfMeasure / nusselt::kPi<double>) << light.name;
        for (int i = 0; i < 100; ++i) {
            const auto sample = biased.sample({random.uniform(), random.uniform()});
            EXPECT_GT(sample.pdf, 0) << light.name;
            EXPECT_NEAR(length(sample.wi), 1, 1e-12) << light.name;
            EXPECT_NEAR(exact.pdf(sample.wi) * exact.measure() / biased.measure() / sample.pdf, 1, 1e-12)
                << light.name;
        }
    }
}

TEST(BiasedTest, CentralCaseIsAlmostExact) {
    const auto light = make_light<double>(polygon_cases().front());
    const nusselt::PolygonProjectedSolidAngle<double, 4> exact(light);
    const nusselt::PolygonProjectedSolidAngleBiased<double, 4> biased(light);
    for (const auto& u : midpoints<PolygonAreaKind, double>(10)) {
        // The azimuth comes from up to five arctangents with errors of 1.3e-5, and from a few steps of interpolation.
        // The budget is three times that.
        EXPECT_LE(length(exact.sample(u).wi - biased.sample(u).wi), 2e-4);
    }
}

} // namespace
} // namespace nusselt_test
