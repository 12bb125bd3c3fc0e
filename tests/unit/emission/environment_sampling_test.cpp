/// Tests of sampling of environments: densities, inversion, means and their mutants, spikes, black maps.

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "emission/environments.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::CosineFactor;
using nusselt::EnvironmentCosine;
using nusselt::EnvironmentSampler;
using nusselt::Frame;
using nusselt::LobeFactor;
using nusselt::octahedral_direction;
using nusselt::Vec2;
using nusselt::Vec3;

/// Bright and dark texels side by side, with black regions and one channel brighter than the others.
template <class T>
MapTexels<T> rough_texels(int size) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    return {size, [&](int i, int j) {
                const double r = (i / 5 + j / 5) % 3 == 0 ? 0 : std::pow(uniform(random), 8);
                return Vec3<T>{static_cast<T>(r), static_cast<T>(0.5 * r), static_cast<T>(2 * r)};
            }};
}
template <class T>
MapTexels<T> sky_texels(int size) {
    return texels_of<T>(size, [](const auto& w) { return grey<T>(sky_with_sun(w)); });
}

template <class T>
nusselt::Ltc<T> lobe_of(const nusselt::LtcCoefficients<long double>& c) {
    return nusselt::Ltc<T>({static_cast<T>(c.m00), static_cast<T>(c.m02), static_cast<T>(c.m11),
                            static_cast<T>(c.m20), static_cast<T>(c.m22), T(1)});
}

/// One kind of technique: lattice and factor.
template <int n_, template <class> class Factor_>
struct Variant {
    static constexpr int n = n_;
    static constexpr bool kHasLobe = std::is_same_v<Factor_<double>, LobeFactor<double>>;
    template <class T>
    using Technique = EnvironmentSampler<T, n, Factor_<T>>;

    template <class T>
    static nusselt::Ltc<T> lobe() {
        return lobe_of<T>(tilted_lobe(0.5L, 0.4L, 1.1L, 0.1L));
    }
    template <class T>
    static Technique<T> technique(const nusselt::EnvironmentMap<T, n>& map, const Frame<T>& frame) {
        if constexpr (kHasLobe)
            return Technique<T>(map, frame, {lobe<T>()});
        else
            return Technique<T>(map, frame);
    }
    /// The integrand that the technique is for, without the radiance.
    template <class T>
    static T integrand(const Vec3<T>& wi) {
        if constexpr (kHasLobe)
            return lobe<T>().density(wi);
        else
            return std::max(wi.z, T(0));
    }
};

template <class Variant>
class EnvironmentTest : public ::testing::Test {};
using Variants = ::testing::Types<Variant<16, CosineFactor>, Variant<8, CosineFactor>,
                                  Variant<16, LobeFactor>, Variant<8, LobeFactor>>;
TYPED_TEST_SUITE(EnvironmentTest, Variants);

/// Random surfaces, and some that see the axes of the map.
std::vector<Frame<double>> some_frames() {
    auto frames = random_frames(3);
    for (const Vec3<double>& normal : {Vec3<double>{0, 0, 1}, {0, 0, -1}, {1, 0, 0}})
        frames.push_back(Frame<double>::from_normal(normal));
    return frames;
}

template <int n, class Function>
void for_each_case(const Function& f) {
    for (const MapTexels<double>& texels : {rough_texels<double>(32), sky_texels<double>(64)}) {
        const StoredMap<double, n> stored(texels.view());
        for (const Frame<double>& frame : some_frames()) f(texels, stored.map, frame);
    }
}

/// Densities are bilinear in each quarter of a texel, so their values at the centres have the right sum. Samples that
/// end below the horizon have no density: what is missing is their share.
TYPED_TEST(EnvironmentTest, DensityIntegratesToOne) {
    for_each_case<TypeParam::n>([&](const MapTexels<double>& texels, const auto& map,
                                    const Frame<double>& frame) {
        const auto technique = TypeParam::technique(map, frame);
        const int steps = 2 * texels.size;
        double sum = 0;
        for (int k = 0; k < steps * steps; ++k)
            sum += technique.pdf_at({(k % steps + 0.5) / steps, (k / steps + 0.5) / steps});
        sum *= 4 * nusselt::kPi<double> / (steps * steps);
        if (TypeParam::kHasLobe) {
            ASSERT_NEAR(sum, 1, 1e-9);
            return;
        }
        int dark = 0;
        constexpr int kSamples = 64;
        for (int k = 0; k < kSamples * kSamples; ++k)
            dark +=
                technique.sample({(k % kSamples + 0.5) / kSamples, (k / kSamples + 0.5) / kSamples}).pdf == 0;
        const double share = static_cast<double>(dark) / (kSamples * kSamples);
        ASSERT_NEAR(sum + share, 1, 0.01);
        ASSERT_LT(share, 0.05);
    });
}

TYPED_TEST(EnvironmentTest, SamplesDensitiesAndInversesAgree) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    int count = 0;
    for_each_case<TypeParam::n>(
        [&](const MapTexels<double>& texels, const auto& map, const Frame<double>& frame) {
            const auto technique = TypeParam::technique(map, frame);
            for (int k = 0; k < 200; ++k) {
                const double x = uniform(random);
                const Vec2<double> u{x, uniform(random)};
                const auto s = technique.sample(u);
                if (s.pdf == 0) {
                    ASSERT_LE(s.wi.z, 0);
                    continue;
                }
                ++count;
                ASSERT_NEAR(length(s.wi), 1, 1e-14);
                ASSERT_LT(length(frame.to_world(s.wi) - octahedral_direction(s.at)), 1e-14);
                ASSERT_LT(length(s.p - length(s.p) * s.wi), 1e-14 * length(s.p));
                ASSERT_GT(length(s.p), 1e18);
                ASSERT_GT(texels.view().lookup(s.at).x, 0);
                ASSERT_NEAR(technique.pdf_at(s.at) / s.pdf, 1, 1e-12);
                // Texels have an edge in a few cases, and black texels a zero of the density.
                ASSERT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e-6);
                const Vec2<double> inverse = technique.invert(s.wi);
                ASSERT_NEAR(inverse.x, u.x, 1e-7);
                ASSERT_NEAR(inverse.y, u.y, 1e-7);
            }
        });
    EXPECT_GT(count, 2000);
}

/// All directions that emit and that count can be sampled.
TYPED_TEST(EnvironmentTest, NoLightLacksSamples) {
    for_each_case<TypeParam::n>(
        [&](const MapTexels<double>& texels, const auto& map, const Frame<double>& frame) {
            const auto technique = TypeParam::technique(map, frame);
            for (const MapPoint& point : points_of(texels.view())) {
                const Vec3<double> wi = frame.to_local(point.direction);
                const bool counts = TypeParam::kHasLobe || wi.z > 0;
                ASSERT_EQ(technique.pdf_at(point.at) > 0, counts && point.radiance > 0);
            }
        });
}

/// The sum of estimates relative to the integral, with its standard deviation.
struct Mean {
    double value, deviation;
};

/// \param estimate maps random numbers to an estimate.
template <class Estimate>
Mean mean_of(int samples, double expected, const Estimate& estimate) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    double sum = 0, squares = 0;
    for (int k = 0; k < samples; ++k) {
        const double x = uniform(random);
        const double ratio = estimate(Vec2<double>{x, uniform(random)}) / expected;
        sum += ratio;
        squares += ratio * ratio;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt((squares / samples - mean * mean) / samples)};
}

bool is_one(const Mean& mean) { return std::fabs(mean.value - 1) < 5 * mean.deviation + 1e-3; }

TYPED_TEST(EnvironmentTest, MeanOfEstimatesIsTheIntegral) {
    // Bright texels with black ones in between.
    const MapTexels<double> texels(32, [](int i, int j) {
        return grey<double>(i % 4 == 1 && j % 4 == 2 ? 1 + 0.05 * i + 0.2 * (j % 3) : 0);
    });
    const StoredMap<double, TypeParam::n> stored(texels.view());
    const auto points = points_of(texels.view());
    const auto map = texels.view();
    for (const Vec3<double>& normal : {Vec3<double>{0.1, 0.05, 1}, {0.9, -1, -0.8}}) {
        const auto frame = Frame<double>::from_normal(normalize(normal));
        const auto technique = TypeParam::technique(stored.map, frame);
        const double expected =
            integral(points, frame, [](const auto& wi) { return TypeParam::integrand(wi); });
        // The estimate for a point of the map, with the density of a sample.
        const auto estimate = [&](const Vec2<double>& at, const Vec3<double>& wi, double pdf) {
            return pdf > 0 ? mean_of_channels(map.lookup(at)) * TypeParam::integrand(wi) / pdf : 0;
        };
        EXPECT_TRUE(is_one(mean_of(20000, expected, [&](const Vec2<double>& u) {
            const auto s = technique.sample(u);
            return estimate(s.at, s.wi, s.pdf);
        })));
        // A texel shifted.
        EXPECT_FALSE(is_one(mean_of(20000, expected, [&](const Vec2<double>& u) {
            const auto s = technique.sample(u);
            const Vec2<double> at{nusselt::below_one(s.at.x + 1.0 / 32), s.at.y};
            return estimate(at, s.wi, s.pdf);
        })));
        // Without the Jacobian: directions of the octahedron itself, which does not keep areas.
        EXPECT_FALSE(is_one(mean_of(20000, expected, [&](const Vec2<double>& u) {
            const auto s = technique.sample(u);
            const double x = 2 * s.at.x - 1, y = 2 * s.at.y - 1;
            const double z = 1 - std::fabs(x) - std::fabs(y);
            const Vec3<double> w{z < 0 ? std::copysign(1 - std::fabs(y), x) : x,
                                 z < 0 ? std::copysign(1 - std::fabs(x), y) : y, z};
            return estimate(s.at, frame.to_local(normalize(w)), s.pdf);
        })));
        // The density of a surface that is turned by a tenth of a radian.
        const auto turned_frame =
            Frame<double>::from_normal(frame.to_world({std::sin(0.1), 0, std::cos(0.1)}));
        const auto turned = TypeParam::technique(stored.map, turned_frame);
        EXPECT_FALSE(is_one(mean_of(20000, expected, [&](const Vec2<double>& u) {
            const auto s = technique.sample(u);
            return estimate(s.at, s.wi, turned.pdf_at(s.at));
        })));
    }
}

/// Texels of all sizes in the interior, on edges and in corners: other lookups are black or much darker.
TYPED_TEST(EnvironmentTest, SpikesAreSampled) {
    constexpr int kSize = 32;
    for (const auto& spike :
         {Vec2<int>{9, 20}, Vec2<int>{15, 16}, Vec2<int>{31, 12}, Vec2<int>{7, 0}, Vec2<int>{0, 31}}) {
        for (const double ground : {0.0, 1e-3}) {
            for (const double value : {1.0, 1e20, 1e30}) {
                const MapTexels<float> texels(kSize, [&](int i, int j) {
                    return grey<float>(i == spike.x && j == spike.y ? value : ground);
                });
                const StoredMap<float, TypeParam::n> stored(texels.view());
                const Vec3<double> sun = texel_centre<double>(kSize, spike.x, spike.y);
                // The lobe points away from the eye.
                const Vec3<double> axis = TypeParam::kHasLobe ? Vec3<double>{std::sin(0.5), 0, std::cos(0.5)}
                                                              : Vec3<double>{std::sin(0.7), 0, std::cos(0.7)};
                const auto around = Frame<double>::from_normal(sun);
                const auto frame = Frame<double>::from_normal(around.to_world({-axis.x, axis.y, axis.z}));
                const auto technique = TypeParam::technique(stored.map, converted<float>(frame));
                const double expected = integral(points_of(texels.view()), frame,
                                                 [](const auto& wi) { return TypeParam::integrand(wi); });
                ASSERT_NEAR(technique.measure() / expected, 1, TypeParam::kHasLobe ? 0.08 : 0.02);
                const Mean mean = mean_of(4000, expected, [&](const Vec2<double>& u) {
                    const auto s = technique.sample({nusselt::below_one(static_cast<float>(u.x)),
                                                     nusselt::below_one(static_cast<float>(u.y))});
                    EXPECT_TRUE(s.pdf >= 0 && s.pdf < 1e30f);
                    if (s.pdf == 0) return 0.0;
                    const auto radiance = static_cast<double>(mean_of_channels(texels.view().lookup(s.at)));
                    return radiance * static_cast<double>(TypeParam::integrand(s.wi)) /
                           static_cast<double>(s.pdf);
                });
                // The quadrature has an error of the size of texels.
                ASSERT_NEAR(mean.value, 1, 5 * mean.deviation + 5e-3)
                    << spike.x << ' ' << spike.y << ' ' << value;
                ASSERT_LT(mean.deviation, 0.5 / std::sqrt(4000));
            }
        }
    }
}

TYPED_TEST(EnvironmentTest, BlackMapsHaveNoSamples) {
    const MapTexels<float> texels(32, [](int, int) { return grey<float>(0); });
    const StoredMap<float, TypeParam::n> stored(texels.view());
    const auto technique = TypeParam::technique(stored.map, converted<float>(some_frames()[0]));
    EXPECT_EQ(technique.measure(), 0);
    EXPECT_EQ(technique.unshadowed().x, 0);
    EXPECT_EQ(technique.pdf({0, 0, 1}), 0);
    EXPECT_EQ(technique.pdf_at({0.3f, 0.2f}), 0);
    EXPECT_EQ(technique.invert({0, 0, 1}).x, 0);
    for (const float u : {0.0f, 0.5f, 0.99999994f}) {
        const auto s = technique.sample({u, u});
        EXPECT_EQ(s.pdf, 0);
        EXPECT_EQ(length(s.wi), 1);
    }
}

/// Constant maps: half of the directions light a surface, and all of a lobe is seen.
TYPED_TEST(EnvironmentTest, MeasuresEstimateIntegrals) {
    const MapTexels<double> white(64, [](int, int) { return Vec3<double>{1, 2, 6}; });
    const StoredMap<double, TypeParam::n> stored(white.view());
    for (const Frame<double>& frame : some_frames()) {
        const auto technique = TypeParam::technique(stored.map, frame);
        const double expected = TypeParam::kHasLobe ? 3 : 3 * nusselt::kPi<double>;
        const double tolerance = TypeParam::kHasLobe ? 0.08 : 0.03;
        EXPECT_NEAR(technique.measure() / expected, 1, TypeParam::n == 8 ? tolerance : tolerance / 2);
        // Per channel, and per albedo.
        const double reflected = technique.measure() / 3 / (TypeParam::kHasLobe ? 1 : nusselt::kPi<double>);
        EXPECT_NEAR(technique.unshadowed().x, reflected, 1e-9);
        EXPECT_NEAR(technique.unshadowed().z, 6 * reflected, 1e-9);
    }
}

/// Random numbers, normals and lobes at the limits of their range.
template <class T, class MakeTechnique>
void expect_contract(int n, const MakeTechnique& make) {
    std::vector<Frame<T>> frames;
    for (const T x : {T(0), T(1), T(-1), T(1e-7), T(-1e-20)})
        for (const T y : {T(0), T(-1), T(1e-6)})
            for (const T z : {T(0), T(1), T(-1), T(1e-10)})
                if (length(Vec3<T>{x, y, z}) > T(0.5))
                    frames.push_back(Frame<T>::from_normal(normalize(Vec3<T>{x, y, z})));
    const T below_one = 1 - std::numeric_limits<T>::epsilon() / 2;
    const T numbers[] = {0, T(1e-30), T(0.25), T(0.5), T(0.77), below_one};
    int lit = 0;
    for (const Frame<T>& frame : frames) {
        const auto technique = make(frame);
        ASSERT_TRUE(technique.measure() > 0 && technique.measure() <= std::numeric_limits<T>::max()) << n;
        for (const T x : numbers) {
            for (const T y : numbers) {
                const auto s = technique.sample({x, y});
                ASSERT_TRUE(s.pdf >= 0 && s.pdf <= std::numeric_limits<T>::max());
                ASSERT_LT(std::fabs(length(s.wi) - 1), T(1e-5));
                ASSERT_TRUE(s.at.x >= 0 && s.at.x < 1 && s.at.y >= 0 && s.at.y < 1);
                lit += s.pdf > 0;
                const T again = technique.pdf(s.wi);
                ASSERT_TRUE(again >= 0 && again <= std::numeric_limits<T>::max());
                const auto u = technique.invert(s.wi);
                ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
            }
        }
    }
    EXPECT_GT(lit, 300);
}

template <class T>
void expect_contract_of_all() {
    for (const MapTexels<T>& texels : {rough_texels<T>(16), sky_texels<T>(64)}) {
        const StoredMap<T, 8> stored(texels.view());
        expect_contract<T>(8,
                           [&](const Frame<T>& frame) { return EnvironmentCosine<T, 8>(stored.map, frame); });
        for (const NamedLobe& named : all_lobes())
            expect_contract<T>(8, [&](const Frame<T>& frame) {
                return nusselt::EnvironmentLtc<T, 8>(stored.map, frame, {lobe_of<T>(named.coefficients)});
            });
    }
}

TEST(EnvironmentSampler, KeepsTheContractOnHostileSurfaces) {
    expect_contract_of_all<float>();
    expect_contract_of_all<double>();
    expect_contract_of_all<long double>();
}

TYPED_TEST(EnvironmentTest, FloatAgreesWithDouble) {
    const MapTexels<double> texels = sky_texels<double>(64);
    const MapTexels<float> single(
        64, [&](int i, int j) { return nusselt::broadcast<float>(texels.view().at(i, j)); });
    const StoredMap<double, TypeParam::n> stored(texels.view());
    const StoredMap<float, TypeParam::n> stored_single(single.view());
    for (const Frame<double>& frame : some_frames()) {
        const auto technique = TypeParam::technique(stored.map, frame);
        const auto technique_single = TypeParam::technique(stored_single.map, converted<float>(frame));
        EXPECT_NEAR(technique_single.measure() / technique.measure(), 1, 1e-5);
        for (int k = 0; k < 200; ++k) {
            const auto s = technique.sample({(k + 0.5) / 200, std::fmod(0.618034 * k + 0.3, 1.0)});
            if (!TypeParam::kHasLobe && s.wi.z < 1e-5) continue;
            ASSERT_NEAR(technique_single.pdf_at(nusselt::broadcast<float>(s.at)) / s.pdf, 1, 2e-4);
        }
    }
}

} // namespace
} // namespace nusselt_test
