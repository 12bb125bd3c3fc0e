/// Tests of sampling of tubes whose radiance varies along them: densities, inversion, noise, hostile lights.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/line_emission/textured_tube.h>

#include "line_emission/textured_lines.h"

namespace nusselt_test {
namespace {

using nusselt::Cylinder;
using nusselt::CylinderLtc;
using nusselt::CylinderProjectedSolidAngle;
using nusselt::LineProfile;
using nusselt::make_line;
using nusselt::make_line_profile;
using nusselt::TexturedTube;
using nusselt::Vec2;
using nusselt::Vec3;

struct NamedProfile {
    const char* name;
    LineProfile<double> profile;
    double most_noise; ///< relative to a technique that does not know the profile
};

const std::vector<NamedProfile>& profiles() {
    static const std::vector<NamedProfile> list = {
        {"gradient", profile_of<double>(16, [](double x) { return 0.1 + x * x; }), 0.4},
        {"stripes", profile_of<double>(24, [](double x) { return static_cast<int>(6 * x) % 2 + 0.1; }), 0.7},
        {"dots", profile_of<double>(64, dots), 0.7},
    };
    return list;
}

std::vector<Cylinder<double>> tubes() {
    return {{make_line<double>({-0.5, 0.3, 1}, {0.5, 0.4, 1.2}), 0.02},
            {make_line<double>({-3, 0.6, 0.5}, {4, 0.5, 0.6}), 0.1},
            {make_line<double>({1, -0.4, -0.7}, {0.8, 0.9, 1.1}), 0.1}};
}

struct Diffuse {
    template <class T>
    static auto uniform(const Cylinder<T>& tube) {
        return CylinderProjectedSolidAngle<T>(tube);
    }
    template <class T>
    static T integrand(const Vec3<T>& wi) {
        return std::max(wi.z, T(0));
    }
};

struct Specular {
    template <class T>
    static auto uniform(const Cylinder<T>& tube) {
        return CylinderLtc<T>(tube, glossy_lobe<T>());
    }
    template <class T>
    static T integrand(const Vec3<T>& wi) {
        return wi.z > 0 ? glossy_lobe<T>().density(wi) : T(0);
    }
};

template <class Variant, class T>
auto textured(const Cylinder<T>& tube, const LineProfile<T>& profile) {
    const auto technique = Variant::uniform(tube);
    return TexturedTube<T, std::remove_const_t<decltype(technique)>>(technique, tube, profile);
}

template <class Variant>
class TexturedTubeTest : public ::testing::Test {};
using Variants = ::testing::Types<Diffuse, Specular>;
TYPED_TEST_SUITE(TexturedTubeTest, Variants);

double radiance_at(const Cylinder<double>& tube, const LineProfile<double>& profile, const Vec3<double>& p) {
    return profile.lookup(std::clamp(dot(p - tube.axis.p0, tube.axis.s) / tube.axis.length, 0.0, 1.0)).x;
}

/// The mean and standard deviation of estimates over a lattice of random numbers.
template <class Variant, class Technique>
Vec2<double> statistics(const Cylinder<double>& tube, const LineProfile<double>& profile,
                        const Technique& technique) {
    constexpr int kTurns = 12, kSteps = 1024;
    double sum = 0, squares = 0;
    for (int k = 0; k < kTurns * kSteps; ++k) {
        const auto s = technique.sample({(k % kTurns + 0.5) / kTurns, (k / kTurns + 0.5) / kSteps});
        if (s.pdf == 0) continue;
        const double value = radiance_at(tube, profile, s.p) * Variant::integrand(s.wi) / s.pdf;
        sum += value;
        squares += value * value;
    }
    const double mean = sum / (kTurns * kSteps);
    return {mean, std::sqrt(std::max(squares / (kTurns * kSteps) - mean * mean, 0.0))};
}

TYPED_TEST(TexturedTubeTest, IsUnbiasedWithLittleNoise) {
    for (const NamedProfile& named : profiles()) {
        for (const auto& tube : tubes()) {
            const auto technique = textured<TypeParam>(tube, named.profile);
            const auto uniform = TypeParam::uniform(tube);
            const Vec2<double> found = statistics<TypeParam>(tube, named.profile, technique);
            const Vec2<double> expected = statistics<TypeParam>(tube, named.profile, uniform);
            std::printf("%s, radius %g: noise %.4f, without knowledge of the profile %.4f\n", named.name,
                        tube.radius, found.y / found.x, expected.y / expected.x);
            EXPECT_NEAR(found.x / expected.x, 1, 3e-3) << named.name;
            EXPECT_LT(found.y, named.most_noise * expected.y) << named.name;
            // The density of the uniform technique for samples of this one would be wrong.
            const auto mutant = [&](const Vec2<double>& u) {
                auto s = technique.sample(u);
                s.pdf = uniform.pdf(s.wi);
                return s;
            };
            struct Mutant {
                decltype(mutant) sample;
            };
            const Vec2<double> wrong = statistics<TypeParam>(tube, named.profile, Mutant{mutant});
            EXPECT_GT(std::fabs(wrong.x / expected.x - 1), 0.01) << named.name;
        }
    }
}

TYPED_TEST(TexturedTubeTest, SamplesDensitiesAndInversesAgree) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const NamedProfile& named : profiles()) {
        for (const auto& tube : tubes()) {
            const auto technique = textured<TypeParam>(tube, named.profile);
            for (int k = 0; k < 100; ++k) {
                const Vec2<double> u{uniform(random), uniform(random)};
                const auto s = technique.sample(u);
                if (s.pdf == 0) continue;
                ASSERT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e-5) << named.name;
                const Vec2<double> inverse = technique.invert(s.wi);
                ASSERT_NEAR(inverse.x, u.x, 1e-6);
                ASSERT_NEAR(inverse.y, u.y, 1e-6);
            }
        }
    }
}

} // namespace
} // namespace nusselt_test
