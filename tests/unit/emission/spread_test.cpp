/// Tests of grids in front of lights.

#include <cmath>

#include <gtest/gtest.h>

#include <nusselt/emission/spread.h>

namespace nusselt_test {
namespace {

using nusselt::Vec2;
using Vector = nusselt::Vec3<double>;

TEST(Spread, SharesOfTheFluxAreIntegrals) {
    constexpr int kSteps = 1000;
    for (const double slope : {0.02, 0.3, 1.0, 4.0}) {
        const nusselt::Honeycomb<double> honeycomb{{slope, 2 * slope}};
        const nusselt::RadialSpread<double> radial{slope};
        double grid = 0, disc = 0;
        for (int j = 0; j < kSteps; ++j)
            for (int i = 0; i < kSteps; ++i) {
                const auto add = [&](double& sum, const auto& spread) {
                    const Vec2<double> end = spread.domain().high;
                    const double p = (i + 0.5) / kSteps * end.x, q = (j + 0.5) / kSteps * end.y;
                    const double squared = 1 + p * p + q * q;
                    const double share = spread.share(Vector{p, q, 1} / std::sqrt(squared));
                    sum += 4 / nusselt::kPi<double> * end.x * end.y / (kSteps * kSteps) * share /
                           (squared * squared);
                };
                add(grid, honeycomb);
                add(disc, radial);
            }
        EXPECT_NEAR(honeycomb.flux_share() / grid, 1, 1e-4);
        EXPECT_NEAR(radial.flux_share() / disc, 1, 1e-4);
    }
    // Without a limit, all light passes; without holes, none.
    EXPECT_NEAR(nusselt::Honeycomb<float>({{1e30f, 1e30f}}).flux_share(), 1, 1e-5);
    EXPECT_NEAR(nusselt::RadialSpread<float>{1e30f}.flux_share(), 1, 1e-5);
    EXPECT_LT(nusselt::RadialSpread<float>{0}.flux_share(), 1e-10);
    EXPECT_EQ(nusselt::RadialSpread<float>{0}.share({0.1f, 0, 0.99f}), 0);
    EXPECT_EQ(nusselt::Honeycomb<float>({{1, 1}}).share({0, 0, 1}), 1);
    EXPECT_EQ(nusselt::Honeycomb<float>({{1, 1}}).share({0, 0, -1}), 0);
}

} // namespace
} // namespace nusselt_test
