/// Tests of the blue noise that ships with the library, and of the ways streams use it.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/random/blue_noise.h>
#include <nusselt/random/multi_jittered.h>

#include "power_spectrum.h"
#include "random_statistics.h"
#include "shipped_blue_noise.h"

namespace {

using nusselt::BlueNoiseShift;
using nusselt::BlueNoiseView;
using nusselt::pcg4d;
using nusselt::UInt4;
using nusselt::test::relative_power;
using nusselt::test::shipped_blue_noise;

constexpr std::uint32_t kSide = BlueNoiseView::kSide;
constexpr std::uint32_t kRanks = BlueNoiseView::kRanks;

std::vector<std::uint32_t> ranks_of(std::uint32_t channel) {
    std::vector<std::uint32_t> ranks;
    for (std::uint32_t i = 0; i < kRanks; ++i)
        ranks.push_back(shipped_blue_noise().rank(channel * kRanks + i));
    return ranks;
}

/// White noise: ranks in random order.
std::vector<std::uint32_t> shuffled_ranks(std::uint32_t seed) {
    const nusselt::Permutation permutation(kRanks);
    std::vector<std::uint32_t> ranks;
    for (std::uint32_t i = 0; i < kRanks; ++i) ranks.push_back(permutation(i, pcg4d({seed, 0, 0, 0}).x));
    return ranks;
}

/// The relative power of ranks, or of a pattern of pixels with ranks below a limit.
double power_of(const std::vector<std::uint32_t>& ranks, double low, double high, std::uint32_t limit = 0) {
    std::vector<double> values;
    for (const std::uint32_t rank : ranks) values.push_back(limit == 0 ? rank : rank < limit ? 1 : 0);
    return relative_power(values, kSide, low, high);
}

TEST(BlueNoise, EachChannelIsAPermutation) {
    for (std::uint32_t channel = 0; channel < BlueNoiseView::kChannels; ++channel) {
        std::vector<int> counts(kRanks);
        for (const std::uint32_t rank : ranks_of(channel)) {
            ASSERT_LT(rank, kRanks);
            ++counts[rank];
        }
        EXPECT_EQ(counts, std::vector<int>(kRanks, 1)) << channel;
    }
}

// Measured: 1.9e-4 to 2.1e-4 below 0.1, 0.0031 to 0.0036 below 0.2 and 0.064 to 0.070 below 0.3 cycles per pixel.
constexpr struct { double low, high, most; } kBands[] = {{0, 0.1, 4e-4}, {0.1, 0.2, 0.006}, {0.2, 0.3, 0.12}};

TEST(BlueNoise, HasLittlePowerInLowFrequencies) {
    for (std::uint32_t channel = 0; channel < BlueNoiseView::kChannels; ++channel)
        for (const auto& band : kBands)
            EXPECT_LT(power_of(ranks_of(channel), band.low, band.high), band.most)
                << channel << " " << band.low;
}

/// The first ring has 60 pairs of frequencies, the others more: for white noise, the ratio is below a half with probability
/// 1e-6.
TEST(BlueNoise, TestOfTheSpectrumRejectsWhiteNoise) {
    for (std::uint32_t seed = 0; seed < BlueNoiseView::kChannels; ++seed)
        for (const auto& band : kBands)
            EXPECT_GT(power_of(shuffled_ranks(seed), band.low, band.high), 0.5) << seed << " " << band.low;
}

TEST(BlueNoise, PatternsOfTheLowestRanksAreBlue) {
    for (const std::uint32_t limit : {kRanks / 10, kRanks / 4, kRanks / 2, kRanks - kRanks / 4}) {
        for (std::uint32_t channel = 0; channel < BlueNoiseView::kChannels; ++channel)
            EXPECT_LT(power_of(ranks_of(channel), 0, 0.1, limit), 0.1) << channel << " " << limit;
        EXPECT_GT(power_of(shuffled_ranks(limit), 0, 0.1, limit), 0.5) << limit;
    }
}

TEST(BlueNoise, ChannelsAreIndependent) {
    const double level = nusselt::test::sidak_level(28 + 1);
    for (std::uint32_t a = 0; a < BlueNoiseView::kChannels; ++a) {
        for (std::uint32_t b = 0; b <= a; ++b) {
            const auto of_a = ranks_of(a), of_b = ranks_of(b);
            nusselt::test::CellCounts counts;
            for (std::size_t i = 0; i < kRanks; ++i)
                counts.add(static_cast<double>(of_a[i]) / kRanks, static_cast<double>(of_b[i]) / kRanks);
            // A channel with itself is the mutant.
            if (a == b) {
                EXPECT_LT(counts.p_value(), level) << a;
            } else {
                EXPECT_GT(counts.p_value(), level) << a << " " << b;
            }
        }
    }
}

TEST(BlueNoiseShift, TilesTheScreenAndTakesTwoChannels) {
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const UInt4 key = pcg4d({i, 0, 0, 0});
        const BlueNoiseShift shift(key);
        const std::uint32_t x = key.x & 0xfff, y = key.y & 0xfff;
        EXPECT_EQ(shift.x.index(x, y), shift.x.index(x + kSide, y + 5 * kSide));
        EXPECT_EQ(shift.x.begin % (2 * kRanks), 0u);
        EXPECT_EQ(shift.y.begin, shift.x.begin + kRanks);
        for (const BlueNoiseShift::Axis& axis : {shift.x, shift.y}) {
            const std::uint32_t begin = axis.begin, index = axis.index(x, y) - begin;
            EXPECT_LT(begin, BlueNoiseView::kChannels * kRanks);
            EXPECT_LT(index, kRanks);
            EXPECT_EQ((axis.index(x + 1, y) - begin) % kSide, (index + 1) % kSide);
            EXPECT_EQ((axis.index(x, y + 1) - begin) / kSide, (index / kSide + 1) % kSide);
        }
    }
}

TEST(BlueNoiseShift, AllShiftsAndPairsOfChannelsAreEquallyLikely) {
    nusselt::test::CellCounts columns, rows, pairs;
    for (std::uint32_t i = 0; i < 100000; ++i) {
        const BlueNoiseShift shift(pcg4d({i, 0, 0, 1}));
        columns.add(shift.x.column / 64.0, shift.y.column / 64.0);
        rows.add(shift.x.row / 64.0, shift.y.row / 64.0);
        pairs.add((shift.x.begin / kRanks / 2 + shift.x.column % 4 / 4.0) / 4, shift.x.row / 64.0);
    }
    const double level = nusselt::test::sidak_level(3);
    EXPECT_GT(columns.p_value(), level);
    EXPECT_GT(rows.p_value(), level);
    EXPECT_GT(pairs.p_value(), level);
}

TEST(BlueNoise, BitsAreTheRankAboveTheRest) {
    EXPECT_EQ(nusselt::blue_noise_bits(0, 0), 0u);
    EXPECT_EQ(nusselt::blue_noise_bits(1, 0), 1u << 20);
    EXPECT_EQ(nusselt::blue_noise_bits(4095, 0xffffffffu), 0xffffffffu);
}

} // namespace
