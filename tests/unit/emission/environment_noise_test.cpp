/// The noise of one sample of an environment without shadows, and that its mean is right.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "emission/environments.h"
#include "emission/estimates.h"

namespace nusselt_test {
namespace {

using nusselt::EnvironmentCosine;
using nusselt::EnvironmentLtc;
using nusselt::Vec2;
using Frames = std::vector<nusselt::Frame<double>>;

constexpr int kSize = 256;

template <class Technique, class Integrand>
auto estimates(const Technique& technique, const nusselt::OctahedralMap<float>& map,
               const Integrand& integrand) {
    return [&](const Vec2<float>& u) {
        const auto s = technique.sample(u);
        if (s.pdf == 0) return 0.0;
        return static_cast<double>(mean_of_channels(map.lookup(s.at)) * integrand(s.wi)) / s.pdf;
    };
}

struct Budget {
    double cells16, cells8;
};

struct Scene {
    MapTexels<float> texels;
    std::vector<MapPoint> points;

    template <class Radiance>
    explicit Scene(const Radiance& radiance)
        : texels(texels_of<float>(kSize, [&](const auto& w) { return grey<float>(radiance(w)); })),
          points(points_of(texels.view())) {}
};

template <class MakeTechnique, class Integrand>
Moments measure(const Scene& scene, const Frames& frames, const MakeTechnique& make,
                const Integrand& integrand) {
    constexpr int kSamples = 400;
    Moments moments;
    for (const auto& frame : frames) {
        const double expected = integral(scene.points, frame, integrand);
        const auto technique = make(converted<float>(frame));
        moments.add(expected, kSamples, estimates(technique, scene.texels.view(), integrand));
    }
    // Quadrature is right to 1e-3, the mean of the samples within 5 of its standard deviations.
    const double samples = static_cast<double>(kSamples) * static_cast<double>(frames.size());
    EXPECT_LT(std::fabs(moments.bias()), 5 * moments.noise() / std::sqrt(samples) + 1e-3);
    return moments;
}

const auto kCosine = [](const auto& wi) { return std::max(wi.z, wi.z * 0); };

void expect_noise(const std::string& name, const Scene& scene, const Frames& frames, const Budget& budget) {
    const StoredMap<float, 16> map16(scene.texels.view());
    const StoredMap<float, 8> map8(scene.texels.view());
    const Moments cells16 = measure(
        scene, frames, [&](const auto& frame) { return EnvironmentCosine<float, 16>(map16.map, frame); },
        kCosine);
    const Moments cells8 = measure(
        scene, frames, [&](const auto& frame) { return EnvironmentCosine<float, 8>(map8.map, frame); },
        kCosine);
    std::printf("%s: noise %.4f (16 x 16), %.4f (8 x 8)\n", name.c_str(), cells16.noise(), cells8.noise());
    EXPECT_LE(cells16.noise(), budget.cells16);
    EXPECT_LE(cells8.noise(), budget.cells8);
}

TEST(EnvironmentNoise, OfTheSky) { expect_noise("sky", Scene(sky), random_frames(32), {0.085, 0.14}); }

TEST(EnvironmentNoise, OfTheSkyWithASun) {
    const Scene scene(sky_with_sun);
    expect_noise("sky with sun", scene, random_frames(32), {0.085, 0.14});
    expect_noise("sky with sun at the horizon", scene, frames_at_sunset(32), {0.1, 0.14});
}

/// Lobes around the normal, of which half of the width is given.
void expect_noise_of_lobe(const Scene& scene, float width, const Budget& budget) {
    const StoredMap<float, 16> map16(scene.texels.view());
    const StoredMap<float, 8> map8(scene.texels.view());
    const nusselt::Ltc<float> lobe({1 / width, 0, 1 / width, 0, 1, 1});
    const nusselt::Ltc<double> precise({1.0 / width, 0, 1.0 / width, 0, 1, 1});
    const auto density = [&](const auto& wi) {
        if constexpr (std::is_same_v<decltype(wi.z), float>)
            return lobe.density(wi);
        else
            return precise.density(wi);
    };
    const Frames frames = random_frames(32);
    const Moments cells16 = measure(
        scene, frames, [&](const auto& frame) { return EnvironmentLtc<float, 16>(map16.map, frame, {lobe}); },
        density);
    const Moments cells8 = measure(
        scene, frames, [&](const auto& frame) { return EnvironmentLtc<float, 8>(map8.map, frame, {lobe}); },
        density);
    std::printf("lobe of width %g: noise %.4f (16 x 16), %.4f (8 x 8)\n", static_cast<double>(width),
                cells16.noise(), cells8.noise());
    EXPECT_LE(cells16.noise(), budget.cells16);
    EXPECT_LE(cells8.noise(), budget.cells8);
}

TEST(EnvironmentNoise, OfGlossySurfaces) {
    const Scene scene(sky_with_sun);
    expect_noise_of_lobe(scene, 0.5f, {0.08, 0.15});
    expect_noise_of_lobe(scene, 0.15f, {0.3, 0.55});
    expect_noise_of_lobe(scene, 0.05f, {0.9, 1.25});
}

} // namespace
} // namespace nusselt_test
