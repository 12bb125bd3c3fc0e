/// Tests of Sobol' points against the recurrence of their direction numbers, and of the net property before and after
/// scrambling.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/random/pcg.h>
#include <nusselt/random/sobol.h>

namespace {

using nusselt::owen_scramble;
using nusselt::owen_scrambled_sobol;
using nusselt::Pcg32;
using nusselt::reverse_bits;
using nusselt::sobol;
using nusselt::SobolSeeds;
using nusselt::UInt2;

/// Whether 2^m points have exactly one in each box of size 2^-i x 2^(i - m), for each i.
bool is_net(const std::vector<UInt2>& points, int m) {
    for (int i = 0; i <= m; ++i) {
        std::vector<bool> hit(points.size());
        for (const UInt2& p : points) {
            const std::uint64_t column = std::uint64_t{p.x} >> (32 - i);
            const std::uint64_t row = std::uint64_t{p.y} >> (32 - (m - i));
            const auto box = static_cast<std::size_t>((column << (m - i)) | row);
            if (hit[box]) return false;
            hit[box] = true;
        }
    }
    return true;
}

/// Name of the first aligned block of up to 1024 points that is not a net, among the blocks below 4096 and a few
/// others.
template <class Sequence>
std::string first_block_without_net(Sequence point) {
    for (int m = 0; m <= 10; ++m) {
        const std::uint32_t size = std::uint32_t{1} << m;
        std::vector<std::uint32_t> begins{0x80000000u, 0xdeadbeefu / size * size, 0xffffffffu / size * size};
        for (std::uint32_t begin = 0; begin < 4096; begin += size) begins.push_back(begin);
        for (const std::uint32_t begin : begins) {
            std::vector<UInt2> points;
            for (std::uint32_t i = 0; i < size; ++i) points.push_back(point(begin + i));
            if (!is_net(points, m)) return std::to_string(size) + " points from " + std::to_string(begin);
        }
    }
    return {};
}

SobolSeeds random_seeds(Pcg32& generator) {
    SobolSeeds seeds{};
    seeds.order = generator();
    seeds.x = generator();
    seeds.y = generator();
    return seeds;
}

TEST(ReverseBits, MovesEachBit) {
    for (int i = 0; i < 32; ++i) EXPECT_EQ(reverse_bits(std::uint32_t{1} << i), std::uint32_t{1} << (31 - i));
    EXPECT_EQ(reverse_bits(0x12345678u), 0x1e6a2c48u);
}

TEST(Sobol, EqualsTheRecurrenceOfDirectionNumbers) {
    Pcg32 generator(3);
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const std::uint32_t index = i < 10000 ? i : generator();
        std::uint32_t x = 0, y = 0;
        std::uint32_t direction_x = 0x80000000u, direction_y = 0x80000000u;
        for (int b = 0; b < 32; ++b) {
            if ((index >> b & 1) != 0) {
                x ^= direction_x;
                y ^= direction_y;
            }
            direction_x >>= 1;
            direction_y ^= direction_y >> 1;
        }
        ASSERT_EQ(sobol(index).x, x) << index;
        ASSERT_EQ(sobol(index).y, y) << index;
    }
}

TEST(Sobol, AlignedBlocksAreNets) { EXPECT_EQ(first_block_without_net(sobol), ""); }

TEST(Sobol, ScrambledAlignedBlocksAreNets) {
    Pcg32 generator(4);
    for (int i = 0; i < 20; ++i) {
        const SobolSeeds seeds = random_seeds(generator);
        EXPECT_EQ(first_block_without_net([&](std::uint32_t k) { return owen_scrambled_sobol(k, seeds); }),
                  "");
    }
}

TEST(Sobol, TestOfNetsRejectsOthers) {
    Pcg32 generator(5);
    const auto independent = [&](std::uint32_t) {
        UInt2 p{};
        p.x = generator();
        p.y = generator();
        return p;
    };
    EXPECT_NE(first_block_without_net(independent), "");
    EXPECT_NE(first_block_without_net([](std::uint32_t k) { return UInt2{sobol(k).x, sobol(k).x}; }), "");
    // Mutant: a scrambling whose decisions depend on lower bits.
    EXPECT_NE(first_block_without_net([](std::uint32_t k) {
                  const UInt2 p = sobol(k);
                  return UInt2{p.x, p.y * 0x2c1b3c6du + 0x297a2d39u};
              }),
              "");
}

TEST(OwenScramble, IsTheScrambleInsideTheSequence) {
    Pcg32 generator(6);
    for (int i = 0; i < 1000; ++i) {
        const SobolSeeds seeds = random_seeds(generator);
        const std::uint32_t index = generator();
        const UInt2 plain = sobol(owen_scramble(index, seeds.order));
        const UInt2 scrambled = owen_scrambled_sobol(index, seeds);
        EXPECT_EQ(scrambled.x, owen_scramble(plain.x, seeds.x));
        EXPECT_EQ(scrambled.y, owen_scramble(plain.y, seeds.y));
    }
}

// The scrambling is nested: numbers that share their first bits share exactly as many after it.
TEST(OwenScramble, KeepsTheLengthOfCommonPrefixes) {
    Pcg32 generator(7);
    for (int i = 0; i < 20000; ++i) {
        const std::uint32_t seed = generator();
        const std::uint32_t a = generator();
        const int prefix = i % 32;
        const std::uint32_t b =
            a ^ (0x80000000u >> prefix) ^ (prefix < 31 ? generator() >> (prefix + 1) : 0u);
        const std::uint32_t difference = owen_scramble(a, seed) ^ owen_scramble(b, seed);
        ASSERT_EQ(difference >> (31 - prefix), 1u) << prefix;
    }
}

// Each of the 15 swaps in the first four levels happens for half of the seeds, independently of the others.
TEST(OwenScramble, SwapsAreFairAndIndependent) {
    constexpr int kSeeds = 20000;
    constexpr int kSwaps = 15;
    Pcg32 generator(8);
    std::vector<int> both(kSwaps * kSwaps);
    for (int i = 0; i < kSeeds; ++i) {
        const std::uint32_t seed = generator();
        bool swapped[kSwaps];
        for (int node = 1; node <= kSwaps; ++node) {
            // The bits of a node's number are a leading one and the path from the root.
            const int level = node >= 8 ? 3 : node >= 4 ? 2 : node >= 2 ? 1 : 0;
            const std::uint32_t path = static_cast<std::uint32_t>(node) - (1u << level);
            const std::uint32_t x = level > 0 ? path << (32 - level) : 0u;
            swapped[node - 1] = (owen_scramble(x, seed) >> (31 - level) & 1) != 0;
        }
        for (int a = 0; a < kSwaps; ++a)
            for (int b = 0; b < kSwaps; ++b)
                if (swapped[a] && swapped[b]) ++both[static_cast<std::size_t>(a * kSwaps + b)];
    }
    for (int a = 0; a < kSwaps; ++a) {
        for (int b = 0; b < kSwaps; ++b) {
            const double expected = a == b ? 0.5 : 0.25;
            EXPECT_NEAR(both[static_cast<std::size_t>(a * kSwaps + b)] / double{kSeeds}, expected, 0.02)
                << a + 1 << " and " << b + 1;
        }
    }
}

} // namespace
