/// Chi-square tests of samples of environment maps against their density. Wrong samplers must be rejected.

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "emission/environments.h"
#include "hypothesis.h"

namespace nusselt_test {
namespace {

using nusselt::EnvironmentCosine;
using nusselt::EnvironmentLtc;
using nusselt::Frame;
using nusselt::Vec2;
using nusselt::Vec3;

constexpr int kTexels = 32;
constexpr int kBins = 2 * kTexels; // quarters of texels, where densities are bilinear
constexpr int kSamples = 200000;
constexpr double kRejected = 1e-9;
constexpr double kAccepted = 1e-4;

/// Smooth in one half, rough with black texels in the other one.
const MapTexels<double>& texels() {
    static const MapTexels<double> result(kTexels, [](int i, int j) {
        const int noise = (i * 37 + j * 101 + i * j * 13) % 11;
        return grey<double>(i < 16 ? 2 + 0.05 * j : noise < 4 ? 0 : noise);
    });
    return result;
}

Frame<double> surface() { return Frame<double>::from_normal(normalize(Vec3<double>{0.3, -0.4, 0.5})); }

struct Cosine {
    static constexpr int n = 16;
    static EnvironmentCosine<double, n> technique(const nusselt::EnvironmentMap<double, n>& map,
                                                  const Frame<double>& frame) {
        return {map, frame};
    }
};
struct CosineOfEight {
    static constexpr int n = 8;
    static EnvironmentCosine<double, n> technique(const nusselt::EnvironmentMap<double, n>& map,
                                                  const Frame<double>& frame) {
        return {map, frame};
    }
};
struct Lobe {
    static constexpr int n = 16;
    static EnvironmentLtc<double, n> technique(const nusselt::EnvironmentMap<double, n>& map,
                                               const Frame<double>& frame) {
        return {map, frame, {nusselt::Ltc<double>({2, 0.2, 2.2, -0.1, 1, 1})}};
    }
};

/// Tests the points of the map that sample() finds against the density of a technique. The density at the centre of a
/// bin is its mean, unless the horizon cuts the bin: such bins count for neither side.
template <class Technique, class Sample>
double p_value(const Technique& technique, const Frame<double>& frame, const Sample& sample) {
    std::vector<double> expected;
    std::vector<bool> is_cut;
    for (int j = 0; j < kBins; ++j) {
        for (int i = 0; i < kBins; ++i) {
            int above = 0;
            for (int k = 0; k < 4; ++k) {
                const Vec2<double> corner{static_cast<double>(i + k % 2) / kBins,
                                          static_cast<double>(j + k / 2) / kBins};
                above += dot(frame.n, nusselt::octahedral_direction(corner)) > 0;
            }
            is_cut.push_back(above % 4 != 0);
            expected.push_back(technique.pdf_at({(i + 0.5) / kBins, (j + 0.5) / kBins}) * 4 *
                               nusselt::kPi<double> / (kBins * kBins) * kSamples);
        }
    }
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<std::int64_t> observed(expected.size(), 0);
    for (int k = 0; k < kSamples; ++k) {
        const double x = uniform(random);
        const auto s = sample(Vec2<double>{x, uniform(random)});
        const auto bin = static_cast<std::size_t>(static_cast<int>(s.at.y * kBins) * kBins +
                                                  static_cast<int>(s.at.x * kBins));
        if (s.pdf > 0) ++observed[bin];
    }
    for (std::size_t bin = 0; bin < expected.size(); ++bin)
        if (is_cut[bin]) expected[bin] = static_cast<double>(observed[bin] = 0);
    return chi_square_test(expected, observed);
}

template <class Kind>
class EnvironmentSamplesTest : public ::testing::Test {};
using Kinds = ::testing::Types<Cosine, CosineOfEight, Lobe>;
TYPED_TEST_SUITE(EnvironmentSamplesTest, Kinds);

TYPED_TEST(EnvironmentSamplesTest, FollowTheirDensity) {
    const StoredMap<double, TypeParam::n> stored(texels().view());
    const auto technique = TypeParam::technique(stored.map, surface());
    EXPECT_GT(p_value(technique, surface(), [&](const Vec2<double>& u) { return technique.sample(u); }),
              kAccepted);
}

TYPED_TEST(EnvironmentSamplesTest, ShiftOfATexelIsRejected) {
    const StoredMap<double, TypeParam::n> stored(texels().view());
    const auto technique = TypeParam::technique(stored.map, surface());
    const auto shifted = [&](const Vec2<double>& u) {
        auto s = technique.sample(u);
        s.at.x = nusselt::below_one(s.at.x + 1.0 / kTexels);
        return s;
    };
    EXPECT_LT(p_value(technique, surface(), shifted), kRejected);
}

/// Points that are uniform in their texel, while radiance is interpolated.
TYPED_TEST(EnvironmentSamplesTest, ConstantTexelsAreRejected) {
    const StoredMap<double, TypeParam::n> stored(texels().view());
    const auto technique = TypeParam::technique(stored.map, surface());
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto constant = [&](const Vec2<double>& u) {
        auto s = technique.sample(u);
        s.at.x = (std::floor(s.at.x * kTexels) + uniform(random)) / kTexels;
        s.at.y = (std::floor(s.at.y * kTexels) + uniform(random)) / kTexels;
        return s;
    };
    EXPECT_LT(p_value(technique, surface(), constant), kRejected);
}

/// The surface is turned by a tenth of a radian.
TYPED_TEST(EnvironmentSamplesTest, WrongNormalIsRejected) {
    const StoredMap<double, TypeParam::n> stored(texels().view());
    const auto technique = TypeParam::technique(stored.map, surface());
    const auto turned = TypeParam::technique(
        stored.map, Frame<double>::from_normal(surface().to_world({std::sin(0.1), 0, std::cos(0.1)})));
    EXPECT_LT(p_value(technique, surface(), [&](const Vec2<double>& u) { return turned.sample(u); }),
              kRejected);
}

} // namespace
} // namespace nusselt_test
