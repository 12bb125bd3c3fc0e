/// Tests of the clipped variants of techniques for spheres, disks, ellipses and ellipsoids: no sample is below the surface, and
/// densities integrate functions over the part that is above it.

#include <algorithm>

#include <gtest/gtest.h>

#include <nusselt/cones/cone_clipped.h>

#include "cones/round_cases.h"

namespace nusselt_test {
namespace {

using nusselt::Ltc;
using nusselt::LtcCoefficients;
using nusselt::Vec2;

template <class T, template <class> class Light>
nusselt::ConeClippedSolidAngle<T, Light> by_solid_angle(const Light<T>& light) {
    return nusselt::ConeClippedSolidAngle<T, Light>(light);
}
template <class T, template <class> class Light>
nusselt::ConeClippedLtc<T, Light> by_lobe(const Light<T>& light, const Ltc<T>& ltc) {
    return nusselt::ConeClippedLtc<T, Light>(light, ltc);
}

const LtcCoefficients<double> kLobes[] = {
    {1, 0, 1, 0, 1, 1}, {0.35, -0.08, 0.4, 0.05, 0.9, 1}, {0.06, -0.3, 0.08, 0.4, 0.7, 1}};

template <class Function>
void for_each_light(int count, const Function& f) {
    RandomLights lights(11);
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near})
        for (const Shape shape : kShapes)
            for (int i = 0; i < count; ++i) f(lights(shape, place));
}

/// Compares means of f / pdf and inverses, and expects all samples above the surface.
/// \param change of the density.
/// \return the relative error of the mean.
template <class Technique, class Function>
double estimate_error(const Technique& technique, const Function& f, double expected, double change) {
    constexpr int kSide = 96;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const Vec2<double> u{(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide};
        const auto s = technique.sample(u);
        EXPECT_GE(s.wi.z, 0);
        EXPECT_GT(s.pdf, 0);
        if (!(s.pdf > 0)) continue;
        sum += f(s.wi) / (change * s.pdf) / (kSide * kSide);
        if (i % 67 != 0) continue;
        EXPECT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e-5);
        const auto inverse = technique.invert(s.wi);
        EXPECT_NEAR(inverse.x, u.x, 1e-6);
        EXPECT_NEAR(inverse.y, u.y, 1e-6);
        EXPECT_NEAR(length(cross(s.p, s.wi)), 0, 1e-9 * length(s.p));
    }
    return std::fabs(sum / expected - 1);
}

/// Where the axis of a cone is next to the plane, few lines have most of the error of the interpolant: sums converge slowly.
constexpr double kBudget = 2e-2;

TEST(ConeClippedTest, SolidAngleIsThatOfThePartAboveTheHorizon) {
    const auto f = [](const auto& wi) { return 1 + wi.x / 2; };
    for_each_light(2, [&](const RoundLight& light) {
        const VisiblePart part(silhouette_of(light));
        const auto expected = static_cast<double>(part.integral(f, 0, 1, 0, 1, 256));
        if (expected < 1e-2) return;
        with_light<double>(light, [&](const auto& l) {
            const auto technique = by_solid_angle(l);
            EXPECT_LE(estimate_error(technique, f, expected, 1), kBudget);
            EXPECT_GT(estimate_error(technique, f, expected, 1.06), kBudget);
            const auto one = [](const Point&) { return 1.0L; };
            EXPECT_NEAR(technique.measure() / static_cast<double>(part.integral(one, 0, 1, 0, 1, 256)), 1,
                        0.12);
        });
    });
}

TEST(ConeClippedTest, LobesAreThoseAboveBothHorizons) {
    for_each_light(1, [&](const RoundLight& light) {
        for (const auto& lobe : kLobes) {
            const Ltc<double> ltc(lobe);
            const auto f = [&](const nusselt::Vec3<double>& wi) { return ltc.density(wi); };
            const auto in_long = [&](const Point& wi) {
                return static_cast<long double>(f(nusselt::broadcast<double>(wi)));
            };
            const auto expected =
                static_cast<double>(VisiblePart(silhouette_of(light)).integral(in_long, 0, 1, 0, 1, 256));
            if (expected < 1e-2) continue;
            with_light<double>(light, [&](const auto& l) {
                const auto technique = by_lobe(l, ltc);
                EXPECT_LE(estimate_error(technique, f, expected, 1), kBudget) << light.center.z;
                EXPECT_GT(estimate_error(technique, f, expected, 1.06), kBudget);
                EXPECT_NEAR(technique.measure() / expected, 1, 0.1);
            });
        }
    });
}

TEST(ConeClippedTest, SamplesInFloatAreAboveTheSurface) {
    for_each_light(6, [&](const RoundLight& light) {
        with_light<float>(light, [&](const auto& l) {
            const auto technique =
                by_lobe(l, Ltc<float>(LtcCoefficients<float>{0.35f, -0.08f, 0.4f, 0.05f, 0.9f, 1}));
            const auto solid = by_solid_angle(l);
            for (int i = 0; i < 64; ++i) {
                const Vec2<float> u{(static_cast<float>(i % 8) + 0.5f) / 8,
                                    (static_cast<float>(i / 8) + 0.5f) / 8};
                EXPECT_GE(technique.sample(u).wi.z, 0);
                EXPECT_GE(technique.sample(u).pdf, 0);
                EXPECT_GE(solid.sample(u).wi.z, 0);
            }
        });
    });
}

TEST(ConeClippedTest, LightsBelowTheSurfaceAreDark) {
    const nusselt::Sphere<float> sphere{{0.5f, 1, -2}, 1};
    EXPECT_EQ(by_solid_angle(sphere).measure(), 0);
    EXPECT_EQ(by_solid_angle(sphere).sample({0.3f, 0.6f}).pdf, 0);
    const Ltc<float> ltc(LtcCoefficients<float>{0.06f, -0.3f, 0.08f, 0.4f, 0.7f, 1});
    EXPECT_EQ(by_lobe(sphere, ltc).measure(), 0);
    EXPECT_EQ(by_lobe(sphere, ltc).sample({0.3f, 0.6f}).pdf, 0);
}

} // namespace
} // namespace nusselt_test
