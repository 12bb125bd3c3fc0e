/// Lines and tubes whose radiance varies keep the contract of techniques on hostile lights with hostile profiles.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/line_emission/textured_line.h>
#include <nusselt/line_emission/textured_tube.h>

#include "common/effort.h"
#include "line_emission/textured_lines.h"
#include "sampling/contract.h"

namespace nusselt_test {
namespace {

using nusselt::LineProfile;
using nusselt::scalar_t;
using nusselt::Vec3;
namespace hostile = nusselt::hostile;

template <class Real>
using ProfileOf = LineProfile<scalar_t<Real>>;

struct Line : hostile::LineKind {
    static constexpr auto kMeasure = hostile::Measure::projected_solid_angle;
    static constexpr auto kHorizon = hostile::Horizon::clipped;
    template <class Real>
    static nusselt::TexturedLine<Real> technique(const Light<Real>& light, const ProfileOf<Real>& profile) {
        return {light, profile};
    }
};
struct LineLobe : hostile::LineOnLobeKind {
    static constexpr auto kMeasure = hostile::Measure::lobe;
    static constexpr auto kHorizon = hostile::Horizon::clipped;
    template <class Real>
    static nusselt::TexturedLineLtc<Real> technique(const Light<Real>& light,
                                                    const ProfileOf<Real>& profile) {
        return {light, profile, {nusselt::Ltc<Real>(light.lobe)}};
    }
};
struct Tube : hostile::CylinderKind {
    static constexpr auto kMeasure = hostile::Measure::projected_solid_angle;
    static constexpr auto kHorizon = hostile::Horizon::clipped;
    template <class Real>
    static nusselt::TexturedTube<Real> technique(const Light<Real>& light, const ProfileOf<Real>& profile) {
        return {nusselt::CylinderProjectedSolidAngle<Real>(light), light, profile};
    }
};
struct TubeLobe : hostile::CylinderOnLobeKind {
    static constexpr auto kMeasure = hostile::Measure::lobe;
    static constexpr auto kHorizon = hostile::Horizon::ignored;
    template <class Real>
    static nusselt::TexturedTubeLtc<Real> technique(const Light<Real>& light,
                                                    const ProfileOf<Real>& profile) {
        return {nusselt::CylinderLtc<Real>(light, nusselt::Ltc<Real>(light.lobe)), light, profile};
    }
};

/// Black, one texel, black but for a dot, texels with a ratio of 1e30 or of zero, huge and denormal ones.
template <class T>
std::vector<LineProfile<T>> hostile_profiles() {
    const auto steep = [](double x) { return std::pow(10, 30 * x - 20); };
    return {profile_of<T>(64, [](double) { return 0; }),
            profile_of<T>(1, [](double) { return 1; }),
            profile_of<T>(64, [](double x) { return x > 0.4 && x < 0.415; }),
            profile_of<T>(7, steep),
            profile_of<T>(63, [](double x) { return static_cast<int>(63 * x) % 2 == 0 ? 1e-20 : 1e10; }),
            profile_of<T>(2, [](double x) { return x < 0.5 ? 0 : 1e30; }),
            profile_of<T>(5, [](double x) { return 1e-41 * x; })};
}

/// The first rule that a lane breaks, or nullptr. Densities of samples and of their directions agree up to rounding only: that
/// is counted.
template <class Kind, class T, class Sample, class Random>
const char* broken_rule(const typename Kind::template Light<T>& light, const Sample& sample, T pdf,
                        const Random& inverse, T measure) {
    if (!(std::isfinite(pdf) && pdf >= 0)) return "pdf(wi) is negative or not finite";
    return hostile::violation<Kind, T>(light,
                                       hostile::Outputs<T, Random>{sample, sample.pdf, inverse, measure});
}

/// Whether what only lines have is in its range: the place of a sample, and coefficients.
template <class Technique, class Random>
bool is_in_range(const Technique& technique, const Random& u) {
    using Real = decltype(technique.measure());
    if constexpr (std::is_same_v<Random, Real>) {
        const Real at = technique.sample(u).at;
        const Vec3<Real> colour = technique.unshadowed();
        using nusselt::any;
        const auto bad = !((at >= Real(0)) & (at <= Real(1)) & hostile::all_finite(colour) &
                           (colour.x >= Real(0)) & (colour.y >= Real(0)) & (colour.z >= Real(0)));
        return !any(bad);
    } else {
        return true;
    }
}

/// \tparam Real float, double, long double or a pack.
template <class Kind, class Real>
void expect_contract(std::uint64_t seed, std::int64_t count) {
    using T = scalar_t<Real>;
    using Light = typename Kind::template Light<Real>;
    using Single = typename Kind::template Light<T>;
    using Random = typename Kind::template Random<Real>;
    using SingleRandom = typename Kind::template Random<T>;
    constexpr int kLanes = nusselt::RealTraits<Real>::kLanes;
    const std::vector<LineProfile<T>> profiles = hostile_profiles<T>();
    hostile::HostileLights<T> lights(seed);
    std::int64_t sampled = 0, agreeing = 0, broken = 0;
    for (std::int64_t done = 0; done < count; done += kLanes) {
        Light light;
        Random u;
        Single single[kLanes];
        SingleRandom single_u[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            single[i] = hostile_light<Kind>(lights);
            single_u[i] = hostile_random<Kind>(lights);
            set_lane<T>(light, i, single[i]);
            set_lane<T>(u, i, single_u[i]);
        }
        const auto& profile = profiles[static_cast<std::size_t>(done / kLanes) % profiles.size()];
        const auto technique = Kind::technique(light, profile);
        const nusselt::LightSample<Real> sample = technique.sample(u);
        const Real pdf = technique.pdf(sample.wi);
        const Random inverse = technique.invert(sample.wi);
        const Real measure = technique.measure();
        ASSERT_TRUE(is_in_range(technique, u)) << done;
        for (int i = 0; i < kLanes; ++i) {
            const auto s = get_lane<T, nusselt::LightSample<T>>(sample, i);
            const T again = get_lane<T, T>(pdf, i);
            const char* rule = broken_rule<Kind, T>(
                single[i], s, again, get_lane<T, SingleRandom>(inverse, i), get_lane<T, T>(measure, i));
            sampled += s.pdf > 0;
            agreeing += s.pdf > 0 && std::fabs(again / s.pdf - 1) < T(1e-2);
            if (rule == nullptr) continue;
            if (++broken > 3) continue;
            ADD_FAILURE() << rule << ", profile "
                          << done / kLanes % static_cast<std::int64_t>(profiles.size())
                          << "\n light: " << hexadecimal<T>(single[i])
                          << "\n u: " << hexadecimal<T>(single_u[i]) << "\n wi, pdf, p: " << hexadecimal<T>(s)
                          << "\n pdf(wi), measure: " << again << " " << get_lane<T, T>(measure, i);
        }
    }
    std::printf("%lld lights, %lld of them sampled, %lld with the density of their direction, %lld broken\n",
                static_cast<long long>(count), static_cast<long long>(sampled),
                static_cast<long long>(agreeing), static_cast<long long>(broken));
    EXPECT_EQ(broken, 0);
    // Rounded directions of thin, far and grazing lights have other densities; of ordinary lights they are those of samples
    // within 1e-3, see textured_line_test.cpp and textured_tube_test.cpp.
    EXPECT_GT(sampled, count / 10);
    EXPECT_GT(agreeing, sampled * 3 / 4);
}

template <class Kind>
class HostileTexturedTest : public ::testing::Test {};
using Kinds = ::testing::Types<Line, LineLobe, Tube, TubeLobe>;
TYPED_TEST_SUITE(HostileTexturedTest, Kinds);

TYPED_TEST(HostileTexturedTest, KeepsTheContract) {
    expect_contract<TypeParam, float>(1, at_effort(20'000, 1'000'000));
    expect_contract<TypeParam, double>(2, at_effort(5'000, 200'000));
    expect_contract<TypeParam, long double>(3, at_effort(1'000, 20'000));
}

TYPED_TEST(HostileTexturedTest, KeepsTheContractInPacks) {
    expect_contract<TypeParam, NativeFloat>(4, at_effort(20'000, 2'000'000));
}

/// With almost no radius, densities of the uniform technique are next to the largest number, and a bright dot multiplies them.
TEST(HostileTexturedTube, DensitiesStayFinite) {
    const LineProfile<float> dot = hostile_profiles<float>()[2];
    for (float radius = 1e-36f; radius > 1e-40f; radius *= 0.9f) {
        const nusselt::Cylinder<float> tube{nusselt::make_line<float>({-0.5f, 0.3f, 1}, {0.5f, 0.4f, 1.2f}),
                                            radius};
        const auto technique = Tube::technique(tube, dot);
        for (int k = 0; k < 100; ++k) {
            const auto s = technique.sample({0.328f, (static_cast<float>(k) + 0.5f) / 100});
            ASSERT_TRUE(std::isfinite(s.pdf)) << radius;
            ASSERT_TRUE(std::isfinite(technique.pdf(s.wi))) << radius;
        }
    }
}

} // namespace
} // namespace nusselt_test
