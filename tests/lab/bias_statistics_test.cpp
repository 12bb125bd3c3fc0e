#include "lab/errors/bias_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

namespace nusselt::lab {

namespace {

constexpr int kWidth = 60;
constexpr int kHeight = 44;

/// A channel of a pixel of one frame.
using Noise = std::function<double(int x, int y, std::mt19937_64& engine)>;

BiasStatistics frames_of(const Noise& noise, int count, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    BiasStatistics statistics;
    for (int i = 0; i < count; ++i) {
        image::Image frame = image::make_image(kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (int c = 0; c < 3; ++c)
                    frame.pixels[static_cast<std::size_t>(3 * (y * kWidth + x) + c)] =
                        static_cast<float>(noise(x, y, engine));
        statistics.add(frame);
    }
    return statistics;
}

/// The estimate of one shadow ray in a penumbra over the whole image: its mean is x / width, and bright spots are rare.
double penumbra(int x, int /*y*/, std::mt19937_64& engine) {
    std::uniform_real_distribution<double> uniform;
    const double spot = uniform(engine) < 0.01 ? 10 : 0;
    return (uniform(engine) < static_cast<double>(x) / kWidth ? 1 : 0) + spot;
}

TEST(BiasTest, AcceptsTheRightMeanWithAnyNoise) {
    // One in a thousand fails a test; seeds are fixed.
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const BiasStatistics reference = frames_of(penumbra, 8, 2 * seed);
        const BiasTest test = frames_of(penumbra, 24, 2 * seed + 1).compare(reference);
        EXPECT_TRUE(test.passes()) << seed << ": " << test.frame << " " << test.largest_cell << " "
                                   << test.chi_square;
        EXPECT_GT(test.largest_cell, 1);
        EXPECT_EQ(test.cells, 4 * 3 * 3);
    }
}

TEST(BiasTest, RejectsAWrongMeanInOneCell) {
    const BiasStatistics reference = frames_of(penumbra, 8, 1);
    const auto mutant = [](int x, int y, std::mt19937_64& engine) {
        return penumbra(x, y, engine) * (x / 16 == 2 && y / 16 == 1 ? 1.5 : 1);
    };
    const BiasTest test = frames_of(mutant, 24, 2).compare(reference);
    EXPECT_FALSE(test.passes()) << test.largest_cell;
}

TEST(BiasTest, RejectsASmallFactorEverywhere) {
    const BiasStatistics reference = frames_of(penumbra, 8, 1);
    const auto mutant = [](int x, int y, std::mt19937_64& engine) { return 1.1 * penumbra(x, y, engine); };
    const BiasTest test = frames_of(mutant, 24, 2).compare(reference);
    EXPECT_FALSE(test.passes()) << test.frame;
}

TEST(BiasTest, RejectsSmallErrorsOfEitherSignEverywhere) {
    const auto quiet = [](int, int, std::mt19937_64& engine) {
        return std::uniform_real_distribution<double>(0.5, 1.5)(engine);
    };
    const auto mutant = [&](int x, int y, std::mt19937_64& engine) {
        return quiet(x, y, engine) + ((x / 16 + y / 16) % 2 == 0 ? 0.02 : -0.02);
    };
    const BiasTest test = frames_of(mutant, 24, 2).compare(frames_of(quiet, 24, 1));
    EXPECT_FALSE(test.passes()) << test.chi_square;
    EXPECT_GT(test.chi_square, 5);
}

TEST(BiasTest, NeedsNoNoise) {
    const auto constant = [](double value) { return [value](int, int, std::mt19937_64&) { return value; }; };
    const BiasStatistics reference = frames_of(constant(0.3), 2, 1);
    EXPECT_TRUE(frames_of(constant(0.3), 3, 1).compare(reference).passes());
    EXPECT_TRUE(frames_of(constant(0.3 * (1 + 1e-6)), 3, 1).compare(reference).passes()) << "rounding";
    EXPECT_FALSE(frames_of(constant(0.3 * (1 + 1e-4)), 3, 1).compare(reference).passes());
}

// Rare bright samples make no cell suspicious that has none of them, but they count in the sum.
TEST(BiasTest, TakesDarkCellsTogether) {
    const auto rare = [](double probability) {
        return [probability](int x, int, std::mt19937_64& engine) {
            if (x < 16) return 1.0;
            return std::uniform_real_distribution<double>()(engine) < probability ? 1.0 : 0.0;
        };
    };
    const BiasStatistics reference = frames_of(rare(2e-4), 400, 1);
    EXPECT_TRUE(frames_of(rare(2e-4), 24, 2).compare(reference).passes());
    EXPECT_FALSE(frames_of(rare(1e-3), 24, 2).compare(reference).passes());
}

} // namespace

} // namespace nusselt::lab
