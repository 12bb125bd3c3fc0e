/// The biased variant of projected solid angle sampling: as wrong as documented, and not more.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/estimate/backward_error.h>

#include "experiments/hostile/lights.h"
#include "lights.h"

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

TEST(BiasedTest, ErrorIsSmallButThere) {
    RandomSource random(1);
    std::vector<double> errors;
    while (errors.size() < 20'000) {
        const auto light = random_quad(random);
        const nusselt::PolygonProjectedSolidAngle<double, 4> exact(light);
        const nusselt::PolygonProjectedSolidAngleBiased<double, 4> biased(light);
        if (exact.measure() < 1e-2) continue;
        // Five arctangents and as many differences of them.
        EXPECT_NEAR(biased.measure(), exact.measure(), 10 * 1.3e-5);
        const nusselt::Vec2<double> u{random.uniform(), random.uniform()};
        const double error = nusselt::backward_error(exact, u, biased.sample(u).wi);
        errors.push_back(std::min(error, 1 - error)); // cyclic where the zenith is in the light
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(errors.back(), 0.28);
    EXPECT_LE(errors[errors.size() * 99 / 100], 0.1);
    // Nothing would be gained by the variant if it were exact.
    EXPECT_GE(errors[errors.size() / 2], 1e-6);
}

TEST(BiasedTest, CentralCaseIsAlmostExact) {
    const auto light = make_light<double>(polygon_cases().front());
    const nusselt::PolygonProjectedSolidAngle<double, 4> exact(light);
    const nusselt::PolygonProjectedSolidAngleBiased<double, 4> biased(light);
    for (const auto& u : midpoints<PolygonAreaKind, double>(10)) {
        // An azimuth from up to five arctangents that err by 1.3e-5, and a few steps of interpolation: three times that.
        EXPECT_LE(length(exact.sample(u).wi - biased.sample(u).wi), 2e-4);
    }
}

} // namespace
} // namespace nusselt_test
