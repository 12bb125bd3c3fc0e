/// Tests of sampling of lines whose radiance varies along them: densities, inversion, weights, noise, hostile lights.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/line_emission/textured_line.h>

#include "line_emission/textured_lines.h"

namespace nusselt_test {
namespace {

using nusselt::LineProfile;
using nusselt::LineSegment;
using nusselt::LineTextureSample;
using nusselt::LobeLines;
using nusselt::make_line;
using nusselt::make_line_profile;
using nusselt::ProjectedLines;
using nusselt::TexturedLine;
using nusselt::Vec3;

struct NamedProfile {
    const char* name;
    LineProfile<double> profile;
};

const std::vector<NamedProfile>& profiles() {
    static const std::vector<NamedProfile> list = [] {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> uniform(0, 1);
        return std::vector<NamedProfile>{
            {"constant", profile_of<double>(1, [](double) { return 0.7; })},
            {"gradient", profile_of<double>(16, [](double x) { return 0.25 + x; })},
            {"dots", profile_of<double>(64, dots)},
            {"noise", profile_of<double>(64, [&](double) { return std::pow(uniform(random), 4); })},
        };
    }();
    return list;
}

/// In shading space: above the horizon, along it, through it, close, far.
std::vector<LineSegment<double>> lines() {
    const auto line = [](const Vec3<double>& a, const Vec3<double>& b) { return make_line(a, b); };
    return {line({-0.5, 0.3, 1}, {0.5, 0.4, 1.2}), line({-3, 0.2, 0.1}, {4, 0.1, 0.3}),
            line({1, -0.4, -0.7}, {0.8, 0.9, 1.1}), line({2, 1, 1.5}, {-1, 0.3, -0.4}),
            line({30, -70, 200}, {31, -69, 200.3})};
}

template <template <class> class Measure_>
struct Variant {
    static constexpr bool kHasLobe = std::is_same_v<Measure_<double>, LobeLines<double>>;
    template <class T>
    using Technique = TexturedLine<T, 64, Measure_<T>>;

    template <class T>
    static Technique<T> technique(const LineSegment<T>& line, const LineProfile<T>& profile) {
        if constexpr (kHasLobe)
            return Technique<T>(line, profile, {glossy_lobe<T>()});
        else
            return Technique<T>(line, profile);
    }
    /// The integrand that the technique is for, without the radiance.
    template <class T>
    static T integrand(const Vec3<T>& wi) {
        if constexpr (kHasLobe)
            return wi.z > 0 ? glossy_lobe<T>().density(wi) : T(0);
        else
            return std::max(wi.z, T(0));
    }
};

template <class Variant>
class TexturedLineTest : public ::testing::Test {};
using Variants = ::testing::Types<Variant<ProjectedLines>, Variant<LobeLines>>;
TYPED_TEST_SUITE(TexturedLineTest, Variants);

Vec3<double> point_at(const LineSegment<double>& line, double at) {
    return fma(at * line.length, line.s, line.p0);
}

/// Solid angle per radius and share of the length, in the limit of a thin cylinder.
double solid_angle_density(const LineSegment<double>& line, double at) {
    const Vec3<double> p = point_at(line, at);
    const double squared = dot(p, p);
    return 2 * line.length * length(cross(p, line.s)) / (squared * std::sqrt(squared));
}

/// The mean of f over the length, by the midpoint rule.
template <class Function>
double mean_over(int steps, const Function& f) {
    double sum = 0;
    for (int k = 0; k < steps; ++k) sum += f((k + 0.5) / steps);
    return sum / steps;
}

/// The integral of radiance times the cosine or the lobe.
template <class Variant>
double integral(const LineSegment<double>& line, const LineProfile<double>& profile, int steps) {
    return mean_over(steps, [&](double at) {
        return profile.lookup(at).x * Variant::integrand(normalize(point_at(line, at))) *
               solid_angle_density(line, at);
    });
}

template <class Function>
void for_each_light(const Function& f) {
    for (const NamedProfile& named : profiles())
        for (const auto& line : lines()) f(line, named);
}

template <class Variant, class Technique>
double estimate(const LineProfile<double>& profile, const Technique& technique, double u) {
    const auto s = technique.sample(u);
    return s.pdf > 0 ? profile.lookup(s.at).x * Variant::integrand(s.wi) / s.pdf : 0;
}

TYPED_TEST(TexturedLineTest, DensityIntegratesToOne) {
    for_each_light([](const LineSegment<double>& line, const NamedProfile& named) {
        const auto technique = TypeParam::technique(line, named.profile);
        ASSERT_GT(technique.measure(), 0);
        const double sum =
            mean_over(4096, [&](double at) { return technique.pdf_at(at) * solid_angle_density(line, at); });
        EXPECT_NEAR(sum, 1, 2e-3) << named.name;
    });
}

TYPED_TEST(TexturedLineTest, SamplesDensitiesAndInversesAgree) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    for_each_light([&](const LineSegment<double>& line, const NamedProfile& named) {
        const auto technique = TypeParam::technique(line, named.profile);
        double last = -1;
        for (int k = 0; k < 200; ++k) {
            const double u = (k + uniform(random)) / 200;
            const LineTextureSample<double> s = technique.sample(u);
            ASSERT_GT(s.pdf, 0);
            ASSERT_NEAR(length(s.wi), 1, 1e-14);
            ASSERT_GE(s.at, last);
            last = s.at;
            ASSERT_LT(length(s.p - point_at(line, s.at)), 1e-9 * length(s.p));
            ASSERT_LT(length(s.p - length(s.p) * s.wi), 1e-9 * length(s.p));
            ASSERT_NEAR(technique.invert(s.wi), u, 1e-8);
            // Between cells, where one is black, the density is steep.
            ASSERT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e-5) << named.name;
            ASSERT_NEAR(technique.pdf_at(s.at) / s.pdf, 1, 1e-5) << named.name;
        }
    });
}

/// Samples are spread as the density says: the share of u before a point is the integral of the density up to there.
TYPED_TEST(TexturedLineTest, SamplesHaveTheirDensity) {
    constexpr int kSteps = 2048;
    const auto largest_gap = [](const LineSegment<double>& line, const auto& technique, const auto& density) {
        double below = 0, gap = 0;
        for (int k = 0; k < kSteps; ++k) {
            const double at = (k + 0.5) / kSteps;
            const double step = density(at) * solid_angle_density(line, at) / kSteps;
            if (technique.pdf_at(at) > 0)
                gap = std::max(
                    gap, std::fabs(technique.invert(normalize(point_at(line, at))) - (below + 0.5 * step)));
            below += step;
        }
        return gap;
    };
    for_each_light([&](const LineSegment<double>& line, const NamedProfile& named) {
        const auto technique = TypeParam::technique(line, named.profile);
        EXPECT_LT(largest_gap(line, technique, [&](double at) { return technique.pdf_at(at); }), 1e-3);
        // The density of a technique that does not know the profile is not this one.
        if (named.profile.cells <= 2) return;
        const auto white = profile_of<double>(1, [](double) { return 1; });
        const auto mutant = TypeParam::technique(line, white);
        EXPECT_GT(largest_gap(line, technique, [&](double at) { return mutant.pdf_at(at); }), 0.01);
    });
}

/// The mean over u is the integral, and hardly an estimate is far from it.
TYPED_TEST(TexturedLineTest, EstimatesHaveLittleNoise) {
    constexpr int kSamples = 2000;
    for_each_light([](const LineSegment<double>& line, const NamedProfile& named) {
        const auto technique = TypeParam::technique(line, named.profile);
        const double expected = integral<TypeParam>(line, named.profile, 1 << 14);
        const auto white = profile_of<double>(1, [](double) { return 1; });
        const auto uniform = TypeParam::technique(line, white);
        double squares = 0, squares_without = 0;
        const double mean = mean_over(kSamples, [&](double u) {
            const double ratio = estimate<TypeParam>(named.profile, technique, u) / expected;
            const double without = estimate<TypeParam>(named.profile, uniform, u) / expected;
            squares += (ratio - 1) * (ratio - 1);
            squares_without += (without - 1) * (without - 1);
            return ratio;
        });
        const double noise = std::sqrt(squares / kSamples);
        const double without = std::sqrt(squares_without / kSamples);
        std::printf("%s at %.2g m: noise %.5f, without knowledge of the profile %.5f\n", named.name,
                    length(point_at(line, 0.5)), noise, without);
        EXPECT_NEAR(mean, 1, 2e-3) << named.name;
        EXPECT_LT(noise, named.profile.cells == 2 ? 1e-4 : 0.1) << named.name;
        EXPECT_LT(noise, 0.6 * without + 1e-4) << named.name;
    });
}

/// Many short lines, each with the radiance of its middle, are the reference of coefficients.
TYPED_TEST(TexturedLineTest, CoefficientsArePerChannel) {
    std::vector<Vec3<double>> texels;
    for (int k = 0; k < 32; ++k) texels.push_back({1, 0.1 * k, k < 16 ? 0.5 : 6.0});
    const auto profile = make_line_profile(texels.data(), 32);
    constexpr int kParts = 512;
    for (const auto& line : lines()) {
        Vec3<double> expected{0, 0, 0};
        for (int k = 0; k < kParts; ++k) {
            const LineSegment<double> part{point_at(line, k / double{kParts}), line.s, line.length / kParts};
            const double measure =
                TypeParam::kHasLobe ? nusselt::LineClippedLtc<double>(part, glossy_lobe<double>()).measure()
                                    : projected_solid_angle(part) / nusselt::kPi<double>;
            expected += measure * profile.lookup((k + 0.5) / kParts);
        }
        const auto technique = TypeParam::technique(line, profile);
        const auto found = technique.unshadowed();
        EXPECT_NEAR(found.x / expected.x, 1, 1e-6);
        EXPECT_NEAR(found.y / expected.y, 1, 5e-3);
        // Radiance rises twelvefold within one cell, over which the cosine varies, too.
        EXPECT_NEAR(found.z / expected.z, 1, 0.03);
        const double measure = (found.x + found.y + found.z) / 3;
        EXPECT_NEAR(technique.measure() / measure, TypeParam::kHasLobe ? 1 : nusselt::kPi<double>, 1e-9);
    }
}

/// Between bright dots.
TYPED_TEST(TexturedLineTest, BlackPartsAreNeverSampled) {
    const auto profile = profile_of<float>(64, dots);
    for (const auto& line : lines()) {
        const LineSegment<float> light{nusselt::broadcast<float>(line.p0), nusselt::broadcast<float>(line.s),
                                       static_cast<float>(line.length)};
        const auto technique = TypeParam::technique(light, profile);
        for (int k = 0; k < 5000; ++k) {
            const auto s = technique.sample((static_cast<float>(k) + 0.5f) / 5000);
            if (s.pdf == 0) continue;
            ASSERT_GT(profile.lookup(s.at).x, 0);
        }
    }
}

TYPED_TEST(TexturedLineTest, FloatAgreesWithDouble) {
    for_each_light([](const LineSegment<double>& line, const NamedProfile& named) {
        LineProfile<float> profile{};
        profile.cells = named.profile.cells;
        for (int k = 0; k <= profile.kSlots; ++k) {
            profile.border[k] = static_cast<float>(named.profile.border[k]);
            profile.value[k] = static_cast<float>(named.profile.value[k]);
            profile.before[k] = static_cast<float>(named.profile.before[k]);
            for (int channel = 0; channel < 3; ++channel)
                profile.radiance[channel][k] = static_cast<float>(named.profile.radiance[channel][k]);
        }
        const LineSegment<float> light{nusselt::broadcast<float>(line.p0), nusselt::broadcast<float>(line.s),
                                       static_cast<float>(line.length)};
        const auto single = TypeParam::technique(light, profile);
        const auto exact = TypeParam::technique(line, named.profile);
        EXPECT_NEAR(single.measure() / exact.measure(), 1, 1e-4) << named.name;
        // Positions are as precise as coordinates and directions to the line. That counts next to black parts, where densities grow from zero.
        const double rounding =
            4 * std::numeric_limits<float>::epsilon() * (1 + length(line.p0) / line.length);
        for (int k = 0; k < 100; ++k) {
            const float u = (static_cast<float>(k) + 0.5f) / 100;
            const auto s = single.sample(u);
            ASSERT_LT(length(nusselt::broadcast<double>(s.wi) - exact.sample(u).wi), 1e-4) << named.name;
            const auto at = static_cast<double>(s.at);
            const auto [low, high] =
                std::minmax({exact.pdf_at(std::max(at - rounding, 0.0)), exact.pdf_at(at),
                             exact.pdf_at(std::min(at + rounding, 1.0))});
            for (const float pdf : {s.pdf, single.pdf(s.wi)}) {
                ASSERT_GT(pdf, (1 - 1e-4) * low) << named.name;
                ASSERT_LT(pdf, (1 + 1e-4) * high) << named.name;
            }
        }
    });
}

template <class Technique>
void expect_dark(const Technique& technique) {
    EXPECT_EQ(technique.measure(), 0);
    EXPECT_EQ(technique.unshadowed().x, 0);
    EXPECT_EQ(technique.pdf({0, 0, 1}), 0);
    EXPECT_EQ(technique.pdf_at(0.5f), 0);
    for (const float u : {0.0f, 0.5f, 0.99999994f}) {
        const auto s = technique.sample(u);
        EXPECT_EQ(s.pdf, 0);
        EXPECT_EQ(length(s.wi), 1);
        EXPECT_EQ(technique.invert(s.wi), 0);
    }
}

TYPED_TEST(TexturedLineTest, NothingComesFromWhatCannotBeSeen) {
    const auto black = profile_of<float>(16, [](double) { return 0; });
    const auto white = profile_of<float>(16, [](double) { return 1; });
    const auto dark = [](const Vec3<float>& a, const Vec3<float>& b, const LineProfile<float>& profile) {
        expect_dark(TypeParam::technique(make_line(a, b), profile));
    };
    dark({-1, 0, 1}, {1, 0, 1}, black);
    // Below the surface, in its plane, through the shading point, a point.
    dark({-1, 0.5f, -1}, {1, 0.5f, -1}, white);
    dark({-1, 0.5f, 0}, {1, 0.5f, 0}, white);
    dark({-1, -1, -1}, {1, 1, 1}, white);
    dark({1, 1, 1}, {1, 1, 1}, white);
}

/// The same function as interpolation of texels in an image.
TEST(LineProfile, InterpolatesBetweenTexels) {
    std::vector<Vec3<double>> texels;
    for (int k = 0; k < 9; ++k) texels.push_back({1.0 * ((k * 5) % 7), 1.0 * k, 2});
    const auto profile = make_line_profile(texels.data(), 9);
    Vec3<double> mean{0, 0, 0};
    for (int k = 0; k < 9; ++k) mean += texels[static_cast<std::size_t>(k)] / 9.0;
    for (int k = 0; k <= 200; ++k) {
        const double x = k / 200.0;
        const auto expected =
            nusselt::BilinearFilter::lookup(nusselt::TextureView<double>{texels.data(), 9, 1}, {x, 0.5});
        ASSERT_NEAR(profile.lookup(x).x, expected.x, 1e-12) << x;
        ASSERT_NEAR(profile.lookup(x).y, expected.y, 1e-12) << x;
    }
    EXPECT_NEAR(profile.below(1), mean_of_channels(mean), 1e-12);
    double sum = 0;
    for (int k = 0; k < 3000; ++k) sum += mean_of_channels(profile.lookup((k + 0.5) / 10000)) / 10000;
    EXPECT_NEAR(profile.below(0.3), sum, 1e-6);
}

} // namespace
} // namespace nusselt_test
