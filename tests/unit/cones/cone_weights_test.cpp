/// Tests of the weights of samples: how far densities are from perfect importance sampling.

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "common/effort.h"
#include "cones/round_cases.h"

namespace nusselt_test {
namespace {

using nusselt::ConeSweep;
using nusselt::EllipticCone;

/// Larger half-angles by their tangents, and how much longer than wide cones are at most.
struct Cones {
    const char* name;
    double least, largest, aspect;
    double weight; ///< upper bound of the weight over the mean of one light
};
constexpr Cones kCones[] = {
    {"up to 0.1", 1e-4, 0.1, 10, 1.2}, {"up to 1", 0.1, 1, 100, 1.3}, {"up to 3", 1, 3, 10, 2}};

/// A cone that the horizon cuts.
EllipticCone<float> cut_cone(RandomLights& random, const Cones& cones) {
    const auto frame = nusselt::Frame<double>::from_normal(random.direction());
    const double turn = random.uniform(0, 3.14159);
    const auto e1 = std::cos(turn) * frame.t + std::sin(turn) * frame.b, e2 = cross(frame.n, e1);
    const double a = random.logarithmic(cones.least, cones.largest);
    const double b = a / random.logarithmic(1, cones.aspect);
    // The axis turns around e1 so that the horizon cuts the disk at a random height.
    const double end = 1 - random.logarithmic(1e-4, 1);
    const double height = random.uniform(-1, 1) < 0 ? -end : end;
    const double azimuth = random.uniform(-3.14159, 3.14159);
    const double na = std::cos(azimuth) * a, nb = std::sin(azimuth) * b;
    const nusselt::Vec3<double> normal =
        normalize(std::cos(azimuth) * e1 + std::sin(azimuth) * e2 + (height * std::hypot(na, nb)) * frame.n);
    // The world turns so that this normal is +z.
    const auto world = nusselt::Frame<double>::from_normal(normal);
    const auto local = [&](const auto& v) { return nusselt::broadcast<float>(world.to_local(v)); };
    const double largest = std::max({a, b, 1.0});
    EllipticCone<float> cone{};
    cone.e1 = local(e1);
    cone.e2 = local(e2);
    cone.e3 = local(frame.n);
    cone.a = static_cast<float>(a / largest);
    cone.b = static_cast<float>(b / largest);
    cone.c = static_cast<float>(1 / largest);
    cone.is_visible = true;
    return cone;
}

/// The largest weight of a sample over the mean of its light.
template <int Places>
double largest_weight(const Cones& cones) {
    RandomLights random(41);
    double largest = 0;
    constexpr int kSide = 12;
    for (int i = 0; i < at_effort(400, 30'000); ++i) {
        const ConeSweep<float, Places> sweep(cut_cone(random, cones));
        if (!(sweep.measure() > 0)) continue;
        double sum = 0, most = 0;
        for (int k = 0; k < kSide * kSide; ++k) {
            const auto s = sweep.sample({(static_cast<float>(k % kSide) + 0.5f) / kSide,
                                         (static_cast<float>(k / kSide) + 0.5f) / kSide});
            const double weight = 1 / static_cast<double>(sweep.density_per_cosine(s.wi));
            sum += weight / (kSide * kSide);
            most = std::max(most, weight);
        }
        largest = std::max(largest, most / sum);
    }
    return largest;
}

TEST(ConeWeightsTest, ConesThatTheHorizonCutsHaveBoundedWeights) {
    for (const Cones& cones : kCones) {
        const double few = largest_weight<nusselt::kConePlaces>(cones);
        const double many = largest_weight<nusselt::kFineConePlaces>(cones);
        if (at_effort(false, true)) std::printf("| %s | %.4f | %.4f |\n", cones.name, few, many);
        EXPECT_LE(few, cones.weight) << cones.name;
        EXPECT_LE(many, few) << cones.name;
    }
}

TEST(ConeWeightsTest, SolidAngleHasNearlyConstantWeights) {
    RandomLights random(43);
    double least = 1, largest = 1;
    for (int i = 0; i < at_effort(400, 30'000); ++i) {
        const Place place = kPlaces[i % 6];
        with_light<float>(random(kShapes[i % 4], place), [&](const auto& light) {
            const auto technique = [&]<template <class> class Light>(const Light<float>& l) {
                return nusselt::ConeSolidAngle<float, Light>(l);
            }(light);
            constexpr int kSide = 12;
            std::vector<double> weights;
            double sum = 0;
            for (int k = 0; k < kSide * kSide; ++k) {
                const auto s = technique.sample({(static_cast<float>(k % kSide) + 0.5f) / kSide,
                                                 (static_cast<float>(k / kSide) + 0.5f) / kSide});
                weights.push_back(1 / static_cast<double>(s.pdf));
                sum += weights.back() / (kSide * kSide);
            }
            const auto [low, high] = std::minmax_element(weights.begin(), weights.end());
            least = std::min(least, *low / sum);
            largest = std::max(largest, *high / sum);
        });
    }
    if (at_effort(false, true)) std::printf("| solid angle | %.4f | %.4f |\n", least, largest);
    EXPECT_GE(least, 0.99);
    EXPECT_LE(largest, 1.015);
}

} // namespace
} // namespace nusselt_test
