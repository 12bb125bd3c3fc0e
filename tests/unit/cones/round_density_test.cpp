/// Compares the densities of techniques for round lights with the Jacobians of their maps.

#include <cmath>

#include <gtest/gtest.h>

#include "sampling/lights.h"

namespace nusselt_test {
namespace {

template <class Test>
class DensityTest : public ::testing::Test {};
TYPED_TEST_SUITE_P(DensityTest);

/// The name of the suite in techniques.json.
struct DensitySuite {
    static constexpr std::string_view kName = "density";
};
using Types = Instances<TestedBy<DensitySuite, RoundKinds, RoundOnLobeKinds>, double>;

/// The largest deviation of a density from the reciprocal of the Jacobian, solid angle per du.
/// \param density of (technique, sample).
template <class Kind, class Density>
double largest_error(const Density& density) {
    // Differences have errors of third derivatives times h^2 and of rounding over h.
    constexpr double h = 2e-6;
    double worst = 0;
    for (const auto& light : cases<Kind>()) {
        const typename Kind::template Technique<double> technique(light_for<Kind, double>(light));
        const auto wi = [&](double x, double y) { return technique.sample({x, y}).wi; };
        for (const auto& u : midpoints<Kind, double>(8)) {
            const auto sample = technique.sample(u);
            if (!(sample.pdf > 0)) continue;
            const auto by_x = wi(u.x + h, u.y) - wi(u.x - h, u.y);
            const auto by_y = wi(u.x, u.y + h) - wi(u.x, u.y - h);
            const double jacobian = length(cross(by_x, by_y)) / (4 * h * h);
            worst = std::max(worst, std::fabs(density(technique, sample) * jacobian - 1));
        }
    }
    return worst;
}

/// Errors are at most 2e-5, of elongated lights on a glossy lobe, and 1e-7 without a lobe.
constexpr double kTolerance = 5e-5;

TYPED_TEST_P(DensityTest, IsTheReciprocalOfTheJacobian) {
    using Kind = typename TypeParam::Kind;
    EXPECT_LE(largest_error<Kind>([](const auto&, const auto& s) { return s.pdf; }), kTolerance);
    EXPECT_LE(largest_error<Kind>([](const auto& technique, const auto& s) { return technique.pdf(s.wi); }),
              kTolerance);
}

TYPED_TEST_P(DensityTest, AnErrorOfATenthOfAThousandthIsFound) {
    EXPECT_GT(
        largest_error<typename TypeParam::Kind>([](const auto&, const auto& s) { return 1.0001 * s.pdf; }),
        kTolerance);
}

REGISTER_TYPED_TEST_SUITE_P(DensityTest, IsTheReciprocalOfTheJacobian, AnErrorOfATenthOfAThousandthIsFound);
INSTANTIATE_TYPED_TEST_SUITE_P(Rounds, DensityTest, Types, InstanceNames);

} // namespace
} // namespace nusselt_test
