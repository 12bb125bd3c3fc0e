#pragma once
/// Tests the contract of techniques on many hostile lights. Each kind of light has a file that instantiates the
/// suite.

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "aim.h"
#include "common/effort.h"
#include "contract.h"
#include "flush_denormals.h"

namespace nusselt_test {

/// Runs a technique on hostile lights and reports the first few violations.
/// \param skipped lights of the seed that are left out
template <class Test>
void expect_contract(std::uint64_t seed, int configurations, int skipped = 0) {
    using T = typename Test::Scalar;
    using Real = typename Test::Real;
    using Random = typename Test::ScalarRandom;
    using Sample = nusselt::LightSample<T>;
    HostileLights<T> lights(seed);
    for (int i = 0; i < skipped; ++i) {
        static_cast<void>(hostile_light<typename Test::Kind>(lights));
        static_cast<void>(hostile_random<typename Test::Kind>(lights));
    }
    int failures = 0;
    int lit = 0;
    for (int done = 0; done < configurations && failures < 5; done += Test::kLanes) {
        typename Test::Light packed;
        typename Test::Random u;
        typename Test::ScalarLight light[Test::kLanes];
        Random single_u[Test::kLanes];
        for (int i = 0; i < Test::kLanes; ++i) {
            light[i] = hostile_light<typename Test::Kind>(lights);
            single_u[i] = hostile_random<typename Test::Kind>(lights);
            set_lane<T>(packed, i, light[i]);
            set_lane<T>(u, i, single_u[i]);
        }
        const typename Test::Technique technique(packed);
        const nusselt::LightSample<Real> sample = technique.sample(u);
        const Real pdf = technique.pdf(sample.wi);
        const typename Test::Random inverse = technique.invert(sample.wi);
        const Real measure = technique.measure();
        for (int i = 0; i < Test::kLanes; ++i) {
            const Outputs<T, Random> out{get_lane<T, Sample>(sample, i), get_lane<T, T>(pdf, i),
                                         get_lane<T, Random>(inverse, i), get_lane<T, T>(measure, i)};
            lit += out.sample.pdf > 0;
            const char* broken_rule = violation<typename Test::Kind, T>(light[i], out);
            std::string problem = broken_rule != nullptr ? broken_rule : "";
            // Long double is slow, so this checks one lane of each pack.
            if (problem.empty() && i == done / Test::kLanes % Test::kLanes) {
                problem = aim_violation<typename Test::Kind>(light[i], single_u[i], out.sample);
            }
            if (problem.empty()) continue;
            ++failures;
            ADD_FAILURE() << Test::Kind::kName << ": " << problem << "\n light: " << hexadecimal<T>(light[i])
                          << "\n u: " << hexadecimal<T>(single_u[i])
                          << "\n wi, pdf, p: " << hexadecimal<T>(out.sample)
                          << "\n inverse: " << hexadecimal<T>(out.inverse)
                          << " measure: " << hexadecimal<T>(out.measure);
        }
    }
    // The generator would be useless if most lights were degenerate.
    EXPECT_GT(lit, configurations / 5);
}

/// Polygons with many vertices are slower and share their code with quadrilaterals, and round lights share theirs with one
/// another, so they have fewer configurations.
template <class Kind>
constexpr int kShare = [] {
    if constexpr (kIsPolygon<Kind>) return Kind::kVertices > 4 ? 10 : 1;
    return kIsRound<Kind> ? 10 : 1;
}();

/// Runs a technique on the hostile lights of a seed. With the quick effort, each of the three instruction sets has a third of them,
/// so that a technique meets all.
/// \param configurations of a technique without a share
template <class Test>
void expect_contract_in_parts(std::uint64_t seed, int configurations) {
    const int all = configurations / kShare<typename Test::Kind>;
    // Registers have 16, 32 and 64 bytes. The tests of long double have no packs, and are compiled once.
    constexpr int kPart = static_cast<int>(sizeof(typename Test::Real)) / 32;
    const bool is_whole = Test::kLanes == 1 || at_effort(false, true);
    const int part = is_whole ? all : all / 3;
    expect_contract<Test>(seed, part, is_whole ? 0 : kPart * part);
}

template <class Test>
class HostileTest : public ::testing::Test {};
TYPED_TEST_SUITE_P(HostileTest);

TYPED_TEST_P(HostileTest, NeverFails) {
    constexpr int kConfigurations = sizeof(typename TypeParam::Scalar) == 4   ? 1'000'000
                                    : sizeof(typename TypeParam::Scalar) == 8 ? 200'000
                                                                              : 20'000;
    expect_contract_in_parts<TypeParam>(1, kConfigurations);
}

TYPED_TEST_P(HostileTest, NeverFailsWithDenormalsFlushed) {
    const FlushDenormalsToZero flush;
    // The x87 unit, which computes long double, does not have this mode.
    constexpr int kConfigurations = sizeof(typename TypeParam::Scalar) <= 8 ? 100'000 : 10'000;
    expect_contract_in_parts<TypeParam>(2, kConfigurations);
}

REGISTER_TYPED_TEST_SUITE_P(HostileTest, NeverFails, NeverFailsWithDenormalsFlushed);

/// The name of the suite in techniques.json.
struct ContractSuite {
    static constexpr std::string_view kName = "contract";
};
/// The techniques of the lists in packs of each precision, for INSTANTIATE_TYPED_TEST_SUITE_P.
template <class... Lists>
using HostileTypes = Instances<TestedBy<ContractSuite, Lists...>, NativeFloat, NativeDouble>;

/// The same techniques in long double, without packs.
template <class... Lists>
using HostileLongDouble = Instances<TestedBy<ContractSuite, Lists...>, long double>;

} // namespace nusselt_test
