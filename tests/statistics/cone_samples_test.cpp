/// Tests that samples of spheres, disks, ellipses and ellipsoids follow the cosine, by counts in cells of the light.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "cones/round_cases.h"
#include "hypothesis.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 20'000;
constexpr int kSide = 8;

using Random = nusselt::Vec2<float>;

/// Whether directions differ from those of the cosine in any of some lights. Tiny lights are left out: unit vectors of float do
/// not tell their parts apart.
/// \param draw function of (light, random numbers) to a direction.
template <class Draw>
bool is_rejected(const Draw& draw) {
    std::vector<double> p_values;
    RandomLights lights(21);
    UniformFloats random(4);
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near, Place::elongated}) {
        for (const Shape shape : kShapes) {
            const RoundLight light = lights(shape, place);
            const VisiblePart part(silhouette_of(light));
            const auto cosine = [](const Point& wi) { return std::max(wi.z, 0.0L); };
            std::vector<double> expected;
            long double total = 0;
            for (int i = 0; i < kSide * kSide; ++i) {
                const long double x = static_cast<long double>(i % kSide) / kSide;
                const long double y = static_cast<long double>(i / kSide) / kSide;
                const long double share = part.integral(cosine, x, x + 1.0L / kSide, y, y + 1.0L / kSide, 12);
                total += share;
                expected.push_back(static_cast<double>(share));
            }
            if (!(total > 1e-4L)) continue;
            for (double& e : expected) e *= kSamples / static_cast<double>(total);
            std::vector<std::int64_t> observed(kSide * kSide);
            with_light<float>(light, [&](const auto& l) {
                for (int i = 0; i < kSamples; ++i) {
                    const float x = random();
                    const auto wi = draw(l, Random{x, random()});
                    const auto at = part.place_of(nusselt::broadcast<long double>(wi));
                    const int column = std::min(static_cast<int>(at.x * kSide), kSide - 1);
                    const int row = std::min(static_cast<int>(at.y * kSide), kSide - 1);
                    ++observed[static_cast<std::size_t>(row * kSide + column)];
                }
            });
            p_values.push_back(chi_square_test(expected, observed));
        }
    }
    return reject(p_values);
}

template <template <class> class Light>
nusselt::ConeProjectedSolidAngle<float, Light> technique_for(const Light<float>& light) {
    return nusselt::ConeProjectedSolidAngle<float, Light>(light);
}
template <template <class> class Light>
nusselt::ConeSolidAngle<float, Light> by_solid_angle(const Light<float>& light) {
    return nusselt::ConeSolidAngle<float, Light>(light);
}

TEST(ConeSamplesTest, FollowTheCosine) {
    EXPECT_FALSE(
        is_rejected([](const auto& light, const Random& u) { return technique_for(light).sample(u).wi; }));
}

TEST(ConeSamplesTest, SquaredRandomNumbersAreRejected) {
    EXPECT_TRUE(is_rejected([](const auto& light, const Random& u) {
        return technique_for(light).sample({u.x * u.x, u.y}).wi;
    }));
    EXPECT_TRUE(is_rejected([](const auto& light, const Random& u) {
        return technique_for(light).sample({u.x, u.y * u.y}).wi;
    }));
}

TEST(ConeSamplesTest, SolidAngleIsRejected) {
    EXPECT_TRUE(
        is_rejected([](const auto& light, const Random& u) { return by_solid_angle(light).sample(u).wi; }));
}

/// Whether means of a function over the density differ from integrals over the part above the horizon.
/// \param density of (technique, sample).
template <class Density>
bool means_are_rejected(const Density& density) {
    std::vector<double> p_values;
    RandomLights lights(22);
    UniformFloats random(5);
    for (const Place place : {Place::at_horizon, Place::near, Place::elongated}) {
        for (const Shape shape : kShapes) {
            for (int repeat = 0; repeat < 3; ++repeat) {
                const RoundLight light = lights(shape, place);
                const auto f = [](const Point& wi) {
                    return std::max(wi.z, 0.0L) * (2 + wi.x + 0.5L * wi.y) * (1.5L + wi.z);
                };
                const long double expected = VisiblePart(silhouette_of(light)).integral(f, 0, 1, 0, 1, 96);
                if (!(expected > 1e-4L)) continue;
                with_light<float>(light, [&](const auto& l) {
                    const auto technique = technique_for(l);
                    MeanTest test;
                    for (int i = 0; i < kSamples; ++i) {
                        const float x = random();
                        const auto s = technique.sample({x, random()});
                        if (s.pdf > 0)
                            test.add(f(nusselt::broadcast<long double>(s.wi)) / density(technique, s));
                    }
                    // The slack covers rounding in float and the error of the integral.
                    p_values.push_back(test.p_value(kSamples, expected, 1e-8L));
                });
            }
        }
    }
    return reject(p_values);
}

TEST(ConeSamplesTest, FollowTheirDensity) {
    EXPECT_FALSE(means_are_rejected([](const auto&, const auto& sample) { return sample.pdf; }));
}

TEST(ConeSamplesTest, DensitiesOffByOnePercentAreRejected) {
    EXPECT_TRUE(means_are_rejected([](const auto&, const auto& sample) { return 1.01f * sample.pdf; }));
}

} // namespace
} // namespace nusselt_test
