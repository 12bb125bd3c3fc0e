/// Errors of neighbouring pixels: samplers for screen space move their power to high frequencies, and have no bias.

#include "random/power_spectrum.h"
#include "random/shipped_blue_noise.h"

#include <nusselt/random/light_random.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace {

using nusselt::BlueNoiseView;
using nusselt::Sampler;
using nusselt::Vec2;

constexpr std::size_t kSide = 64;
constexpr std::uint32_t kSampleCounts[] = {1, 2, 4, 16};

/// What pixels integrate over the unit square.
struct Integrand {
    const char* name;
    std::function<double(const Vec2<double>&)> f;
    double integral;
    /// Bounds on the relative power of errors below 0.1 cycles per pixel. Measured: 0.12 to 0.16 and 0.16 to 0.40 for z_sobol;
    /// 2e-4, 0.05 to 0.36, 0.02 to 0.03 and 0.34 to 0.57 for blue noise.
    double most_of_z_sobol, most_of_blue_noise;
};

const std::vector<Integrand>& integrands() {
    static const std::vector<Integrand> all{
        {"smooth, of a line", [](const Vec2<double>& u) { return std::exp(u.x); }, std::exp(1.0) - 1, 0.25,
         0.002},
        {"smooth, of a polygon", [](const Vec2<double>& u) { return std::exp(u.x + u.y); },
         (std::exp(1.0) - 1) * (std::exp(1.0) - 1), 0.25, 0.5},
        {"a shadow on a line", [](const Vec2<double>& u) { return u.x < 0.3 ? 1.0 : 0.0; }, 0.3, 0.3, 0.06},
        {"a shadow on a polygon", [](const Vec2<double>& u) { return 3 * u.x + 2 * u.y < 2 ? 1.0 : 0.0; },
         1.0 / 3, 0.6, 0.7},
    };
    return all;
}

/// A number of the unit square for a sample of a pixel.
using Numbers =
    std::function<Vec2<double>(std::uint32_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t sample)>;

Numbers numbers_of(Sampler kind, std::uint32_t samples,
                   BlueNoiseView blue_noise = nusselt::test::shipped_blue_noise()) {
    return [=](std::uint32_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
        return nusselt::light_random<double>(kind, seed, x, y, sample, samples, 1, 0, blue_noise);
    };
}

double error_of(const Integrand& integrand, const Numbers& numbers, std::uint32_t samples, std::uint32_t seed,
                std::uint32_t x, std::uint32_t y) {
    double sum = 0;
    for (std::uint32_t i = 0; i < samples; ++i) sum += integrand.f(numbers(seed, x, y, i));
    return sum / samples - integrand.integral;
}

/// The power of the errors below 0.1 cycles per pixel, relative to white noise of the same variance: the mean over images.
double low_power(const Integrand& integrand, const Numbers& numbers, std::uint32_t samples) {
    constexpr std::uint32_t kImages = 6;
    double sum = 0;
    for (std::uint32_t seed = 0; seed < kImages; ++seed) {
        std::vector<double> errors;
        // The begin of the image is not aligned with the squares of z_sobol.
        for (std::uint32_t y = 0; y < kSide; ++y)
            for (std::uint32_t x = 0; x < kSide; ++x)
                errors.push_back(error_of(integrand, numbers, samples, seed, x + 37, y + 91));
        sum += nusselt::test::relative_power(errors, kSide, 0, 0.1);
    }
    return sum / kImages;
}

/// White noise has 1, with a standard deviation of 0.05: a mean over 6 images with 60 pairs of frequencies.
constexpr double kLeastOfWhiteNoise = 0.8;

TEST(ScreenSpaceError, OfZSobolHasLittlePowerInLowFrequencies) {
    for (const Integrand& integrand : integrands())
        for (const std::uint32_t samples : kSampleCounts)
            EXPECT_LT(low_power(integrand, numbers_of(Sampler::z_sobol, samples), samples),
                      integrand.most_of_z_sobol)
                << integrand.name << ", " << samples;
}

TEST(ScreenSpaceError, OfBlueNoiseHasLittlePowerInLowFrequencies) {
    for (const Integrand& integrand : integrands())
        for (const std::uint32_t samples : kSampleCounts)
            EXPECT_LT(low_power(integrand, numbers_of(Sampler::blue_noise, samples), samples),
                      integrand.most_of_blue_noise)
                << integrand.name << ", " << samples;
}

TEST(ScreenSpaceError, OfIndependentPixelsIsWhite) {
    for (const Integrand& integrand : integrands())
        for (const std::uint32_t samples : kSampleCounts)
            for (const Sampler kind :
                 {Sampler::independent, Sampler::sobol, Sampler::jittered, Sampler::stratified})
                EXPECT_GT(low_power(integrand, numbers_of(kind, samples), samples), kLeastOfWhiteNoise)
                    << integrand.name << ", " << samples << ", " << static_cast<int>(kind);
}

/// Mutants: blue noise with ranks in random order, and pixels that share a sequence in random order.
TEST(ScreenSpaceError, TestOfTheSpectrumRejectsOtherRanks) {
    std::vector<unsigned char> white(BlueNoiseView::kBytes);
    const nusselt::Permutation ranks(BlueNoiseView::kRanks), pixels(1u << 16);
    for (std::uint32_t i = 0; i < BlueNoiseView::kChannels * BlueNoiseView::kRanks; ++i) {
        const std::uint32_t rank =
            ranks(i % BlueNoiseView::kRanks, nusselt::pcg4d({i / BlueNoiseView::kRanks, 0, 0, 0}).x);
        white[2 * i] = static_cast<unsigned char>(rank & 0xff);
        white[2 * i + 1] = static_cast<unsigned char>(rank >> 8);
    }
    const Numbers without_order = [&](std::uint32_t seed, std::uint32_t x, std::uint32_t y,
                                      std::uint32_t sample) {
        const auto key = nusselt::pcg4d({seed, 0, 0, 0});
        const std::uint32_t rank = pixels(nusselt::z_order(x, y), key.w);
        const auto bits = nusselt::owen_scrambled_sobol(4 * rank + sample, {key.z, key.x, key.y});
        return Vec2<double>{nusselt::to_unit<double>(bits.x), nusselt::to_unit<double>(bits.y)};
    };
    for (const Integrand& integrand : integrands()) {
        const Numbers of_white = numbers_of(Sampler::blue_noise, 4, {white.data()});
        EXPECT_GT(low_power(integrand, of_white, 4), kLeastOfWhiteNoise) << integrand.name;
        EXPECT_GT(low_power(integrand, without_order, 4), kLeastOfWhiteNoise) << integrand.name;
    }
}

/// How many standard deviations the mean error of a pixel over many seeds is from 0.
double deviation_over_seeds(const Integrand& integrand, const Numbers& numbers, std::uint32_t samples) {
    constexpr std::uint32_t kSeeds = 10000;
    double sum = 0, squares = 0;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        const double error = error_of(integrand, numbers, samples, seed, 300, 170);
        sum += error;
        squares += error * error;
    }
    return std::fabs(sum) / std::sqrt(squares);
}

/// 24 deviations, of which one exceeds 4.5 with probability 2e-4.
TEST(ScreenSpaceError, HasMeanZeroOverSeeds) {
    for (const Integrand& integrand : integrands())
        for (const std::uint32_t samples : {1u, 3u, 4u})
            for (const Sampler kind : {Sampler::z_sobol, Sampler::blue_noise}) {
                const Numbers numbers = numbers_of(kind, samples);
                EXPECT_LT(deviation_over_seeds(integrand, numbers, samples), 4.5)
                    << integrand.name << ", " << samples << ", " << static_cast<int>(kind);
                // Mutant: the last 20th of the interval is missing.
                const Numbers biased = [&](std::uint32_t seed, std::uint32_t x, std::uint32_t y,
                                           std::uint32_t sample) {
                    const Vec2<double> u = numbers(seed, x, y, sample);
                    return Vec2<double>{0.95 * u.x, u.y};
                };
                // One sample of a shadow is too noisy to tell.
                if (samples > 1) {
                    EXPECT_GT(deviation_over_seeds(integrand, biased, samples), 4.5)
                        << integrand.name << ", " << samples;
                }
            }
}

} // namespace
