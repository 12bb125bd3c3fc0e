/// Compares every lane of a technique on packs with the same technique on scalars, bit for bit: with different lights
/// in the lanes, with one light in all lanes, and with a neighbour lane full of NaN. Scalar code that takes the vertices
/// of a light as lanes rounds in another way: there, packs of a single lane replace scalars, and another test bounds the
/// difference between scalars and packs.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "contract.h"
#include "lights.h"
#include "proof/techniques/fine_round_kinds.h"

namespace nusselt_test {
namespace {

/// Whether all numbers in two structures of numbers have the same bits, apart from the sign of zeros.
template <class Number, class T>
bool same_numbers(const T& a, const T& b) {
    constexpr std::size_t kCount = sizeof(T) / sizeof(Number);
    Number x[kCount], y[kCount];
    std::memcpy(x, &a, sizeof x);
    std::memcpy(y, &b, sizeof y);
    return std::equal(x, x + kCount, y,
                      [](Number p, Number q) { return p == q || std::memcmp(&p, &q, sizeof p) == 0; });
}

/// Whether the scalar code of a technique takes the vertices of a light as lanes.
template <class Case>
constexpr bool takes_vertices_as_lanes() {
    constexpr std::string_view kName = Case::Kind::kName;
    return std::is_same_v<typename Case::Scalar, float> && kName.starts_with("Polygon") &&
           (kName.find("ProjectedSolidAngle") != kName.npos || kName.find("Ltc") != kName.npos);
}

template <class Case>
class PacksTest : public ::testing::Test {
protected:
    using Number = typename Case::Scalar;
    using Random = typename Case::ScalarRandom;
    using Sample = nusselt::LightSample<Number>;
    using Outputs = nusselt_test::Outputs<Number, Random>;

    static Outputs run_scalar(const typename Case::ScalarTechnique& technique, const Random& u) {
        const Sample sample = technique.sample(u);
        return {sample, technique.pdf(sample.wi), technique.invert(sample.wi), technique.measure()};
    }

    /// What a lane of a pack is to have for this light.
    static Outputs run_one(const typename Case::ScalarLight& light, const Random& u) {
        if constexpr (takes_vertices_as_lanes<Case>()) {
            using OneLane = nusselt::Pack<Number, 1>;
            typename Case::Kind::template Light<OneLane> one_light;
            typename Case::Kind::template Random<OneLane> one_u;
            set_lane<Number>(one_light, 0, light);
            set_lane<Number>(one_u, 0, u);
            const typename Case::Kind::template Technique<OneLane> technique(one_light);
            const auto sample = technique.sample(one_u);
            return {get_lane<Number, Sample>(sample, 0),
                    get_lane<Number, Number>(technique.pdf(sample.wi), 0),
                    get_lane<Number, Random>(technique.invert(sample.wi), 0),
                    get_lane<Number, Number>(technique.measure(), 0)};
        } else {
            return run_scalar(typename Case::ScalarTechnique(light), u);
        }
    }

    void expect_lane(const Outputs& expected, int lane) const {
        const auto here = [&](const auto& packed, const auto& single) {
            return get_lane<Number, std::decay_t<decltype(single)>>(packed, lane);
        };
        // If a light is as thin as its rounding errors, its measure depends on the number of vertices after clipping,
        // which depends on whether the light of any other lane crosses the horizon. One light in a few million is so
        // thin.
        constexpr Number kThin = std::numeric_limits<Number>::epsilon() / 100;
        if (std::max(here(measure_, expected.measure), expected.measure) < kThin) return;
        EXPECT_PRED2((same_numbers<Number, Number>), here(measure_, expected.measure), expected.measure)
            << "lane " << lane;
        EXPECT_EQ(here(sample_, expected.sample).pdf, expected.sample.pdf);
        // Without a sample, direction and point have no meaning.
        if (expected.sample.pdf == 0) return;
        EXPECT_PRED2((same_numbers<Number, Sample>), here(sample_, expected.sample), expected.sample)
            << "lane " << lane;
        EXPECT_PRED2((same_numbers<Number, Number>), here(pdf_, expected.pdf), expected.pdf)
            << "lane " << lane;
        EXPECT_PRED2((same_numbers<Number, Random>), here(inverse_, expected.inverse), expected.inverse)
            << "lane " << lane;
    }

    void run(const typename Case::Technique& technique, const typename Case::Random& u) {
        sample_ = technique.sample(u);
        pdf_ = technique.pdf(sample_.wi);
        inverse_ = technique.invert(sample_.wi);
        measure_ = technique.measure();
    }

private:
    nusselt::LightSample<typename Case::Real> sample_;
    typename Case::Real pdf_, measure_;
    typename Case::Random inverse_;
};

/// The name of the suite in techniques.json.
struct PacksSuite {
    static constexpr std::string_view kName = "packs";
};
using Types =
    Instances<Join<TestedBy<PacksSuite, KindsWithBounds<4, 8>>, FineRoundKinds>, NativeFloat, NativeDouble>;
TYPED_TEST_SUITE(PacksTest, Types, InstanceNames);

TYPED_TEST(PacksTest, LightPerLaneBesideNaN) {
    using T = typename TypeParam::Scalar;
    using Kind = typename TypeParam::Kind;
    constexpr int kLanes = TypeParam::kLanes;
    const auto ordinary = cases<Kind>();
    HostileLights<T> hostile(3);
    // As many lights for wide packs as for the narrow ones of SSE, in which each lane meets NaN hundreds of times.
    constexpr int kRounds = std::min(3000, 12'000 / kLanes);
    for (int round = 0; round < kRounds && !this->HasFailure(); ++round) {
        const int poisoned = round % kLanes;
        typename TypeParam::Light lights;
        typename TypeParam::Random u;
        typename TypeParam::ScalarLight light[kLanes];
        typename TypeParam::ScalarRandom single_u[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            // Half of the lights are ordinary, so that central and decentral cases, clipped and whole lights mix.
            light[i] =
                i % 2 == 0
                    ? light_for<Kind, T>(ordinary[static_cast<std::size_t>(round + i) % ordinary.size()])
                    : hostile_light<Kind>(hostile);
            single_u[i] = hostile_random<Kind>(hostile);
            auto shown = light[i];
            if (i == poisoned) std::memset(&shown, 0xff, sizeof shown); // quiet NaN in every number
            set_lane<T>(lights, i, shown);
            set_lane<T>(u, i, single_u[i]);
        }
        this->run(typename TypeParam::Technique(lights), u);
        for (int i = 0; i < kLanes; ++i) {
            if (i == poisoned) continue;
            this->expect_lane(TestFixture::run_one(light[i], single_u[i]), i);
        }
    }
}

/// Tolerances are ten times the largest differences.
TYPED_TEST(PacksTest, ScalarsSampleTheSameMap) {
    using T = typename TypeParam::Scalar;
    using Kind = typename TypeParam::Kind;
    if constexpr (takes_vertices_as_lanes<TypeParam>()) {
        for (const auto& ordinary : cases<Kind>()) {
            const auto light = light_for<Kind, T>(ordinary);
            const typename TypeParam::ScalarTechnique technique(light);
            // Without the tips of thin lights, where directions are as sensitive as square roots next to zero.
            for (const auto& u : midpoints<Kind, T>(14)) {
                const auto scalar = TestFixture::run_scalar(technique, u);
                const auto packed = TestFixture::run_one(light, u);
                EXPECT_NEAR(scalar.measure, packed.measure, 2.5e-6f * packed.measure);
                EXPECT_EQ(scalar.sample.pdf > 0, packed.sample.pdf > 0);
                if (!(packed.sample.pdf > 0)) continue;
                const auto difference = scalar.sample.wi - packed.sample.wi;
                EXPECT_LE(std::sqrt(dot(difference, difference)), 5e-6f) << "u = " << u.x << ", " << u.y;
                EXPECT_NEAR(scalar.sample.pdf, packed.sample.pdf, 2e-5f * packed.sample.pdf);
                EXPECT_NEAR(scalar.pdf, packed.pdf, 2e-5f * packed.pdf);
                const auto apart = scalar.sample.p - packed.sample.p;
                EXPECT_LE(std::sqrt(dot(apart, apart)),
                          6e-6f * std::sqrt(dot(packed.sample.p, packed.sample.p)));
                EXPECT_NEAR(scalar.inverse.x, packed.inverse.x, 2e-5f);
                EXPECT_NEAR(scalar.inverse.y, packed.inverse.y, 2e-5f);
            }
        }
    }
}

TYPED_TEST(PacksTest, OneLightBroadcastToAllLanes) {
    using T = typename TypeParam::Scalar;
    using Kind = typename TypeParam::Kind;
    constexpr int kLanes = TypeParam::kLanes;
    HostileLights<T> hostile(4);
    const auto ordinary = cases<Kind>();
    for (std::size_t round = 0; round < 300 && !this->HasFailure(); ++round) {
        const auto light =
            round < ordinary.size() ? light_for<Kind, T>(ordinary[round]) : hostile_light<Kind>(hostile);
        const typename TypeParam::ScalarTechnique single(light);
        typename TypeParam::Random u;
        typename TypeParam::ScalarRandom single_u[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            single_u[i] = hostile_random<Kind>(hostile);
            set_lane<T>(u, i, single_u[i]);
        }
        this->run(typename TypeParam::Technique(single), u);
        for (int i = 0; i < kLanes; ++i) this->expect_lane(TestFixture::run_scalar(single, single_u[i]), i);
    }
}

} // namespace
} // namespace nusselt_test
