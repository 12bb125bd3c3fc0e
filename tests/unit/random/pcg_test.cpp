/// Tests of random bits (published values and an independent reference) and of their conversion to the unit interval.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <nusselt/random/pcg.h>
#include <nusselt/random/unit_interval.h>

namespace {

using nusselt::Pcg32;
using nusselt::pcg4d;
using nusselt::to_unit;
using nusselt::UInt4;
using nusselt::uniform_jittered;

/// pcg4d from its description: a linear congruential step, then two rounds in which component i gains the product of
/// two others, with a shift between the rounds. Uses 64-bit integers modulo 2^32.
std::array<std::uint64_t, 4> reference_pcg4d(std::array<std::uint64_t, 4> v) {
    constexpr std::uint64_t kModulus = std::uint64_t{1} << 32;
    constexpr std::size_t kFactors[4][2] = {{1, 3}, {2, 0}, {0, 1}, {1, 2}};
    for (auto& x : v) x = (x * 1664525 + 1013904223) % kModulus;
    for (int round = 0; round < 2; ++round) {
        if (round == 1)
            for (auto& x : v) x ^= x / 65536;
        for (std::size_t i = 0; i < 4; ++i)
            v[i] = (v[i] + v[kFactors[i][0]] * v[kFactors[i][1]] % kModulus) % kModulus;
    }
    return v;
}

TEST(Pcg4d, EqualsTheReference) {
    std::mt19937 generator(1);
    const auto random = [&] { return static_cast<std::uint32_t>(generator()); };
    for (int i = 0; i < 10000; ++i) {
        const UInt4 key = i == 0 ? UInt4{0, 0, 0, 0} : UInt4{random(), random(), random(), random()};
        const UInt4 hash = pcg4d(key);
        const auto reference = reference_pcg4d({key.x, key.y, key.z, key.w});
        ASSERT_EQ((std::array<std::uint64_t, 4>{hash.x, hash.y, hash.z, hash.w}), reference);
    }
}

// Leaves out the highest bit of a word. No carry can spread it, so it flips high bits with probability 0.63.
TEST(Pcg4d, FlippingABitOfTheKeyFlipsAboutHalfOfTheHighBits) {
    constexpr int kKeys = 4096;
    for (int word = 0; word < 4; ++word) {
        for (int bit = 0; bit < 31; ++bit) {
            int flips = 0;
            for (std::uint32_t i = 0; i < kKeys; ++i) {
                std::uint32_t key[4] = {i & 63, i >> 6, 3, 0x9e3779b9u};
                const UInt4 a = pcg4d({key[0], key[1], key[2], key[3]});
                key[word] ^= std::uint32_t{1} << bit;
                const UInt4 b = pcg4d({key[0], key[1], key[2], key[3]});
                flips += static_cast<int>((a.x ^ b.x) >> 31) + static_cast<int>((a.y ^ b.y) >> 31);
            }
            EXPECT_NEAR(flips / (2.0 * kKeys), 0.5, 0.1) << "word " << word << " bit " << bit;
        }
    }
}

// The first values that the demonstration of the reference implementation prints for seed 42 and stream 54.
TEST(Pcg32, GivesThePublishedValues) {
    Pcg32 generator(42, 54);
    for (const std::uint32_t expected :
         {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
        EXPECT_EQ(generator(), expected);
}

TEST(Pcg32, StreamsDiffer) {
    std::set<std::uint32_t> first_values;
    for (std::uint64_t stream = 0; stream < 1000; ++stream) first_values.insert(Pcg32(7, stream)());
    EXPECT_GT(first_values.size(), 990u);
}

TEST(Pcg32, IsAStandardGenerator) {
    Pcg32 generator(1);
    std::uniform_int_distribution<int> dice(1, 6);
    std::array<int, 7> counts{};
    for (int i = 0; i < 60000; ++i) ++counts.at(static_cast<std::size_t>(dice(generator)));
    for (std::size_t face = 1; face <= 6; ++face) EXPECT_NEAR(counts[face], 10000, 500);
}

TEST(ToUnit, IsExactAndBelowOne) {
    EXPECT_EQ(to_unit(0), 0.0f);
    EXPECT_EQ(to_unit(0x80000000u), 0.5f);
    EXPECT_EQ(to_unit(0x000001ffu), 0x1p-24f);
    EXPECT_EQ(to_unit(0xffffffffu), 1 - 0x1p-24f);
    EXPECT_EQ(to_unit<double>(1u), 0x1p-32);
    EXPECT_EQ(to_unit<double>(0xffffffffu), 1 - 0x1p-32);
    EXPECT_EQ(to_unit<long double>(0xffffffffu), 1 - 0x1p-32L);
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << 32; bits += 4001) {
        const auto word = static_cast<std::uint32_t>(bits);
        ASSERT_EQ(static_cast<double>(to_unit(word)), static_cast<double>(word >> 8) / (1 << 24));
    }
}

template <class Scalar>
void expect_strata_hit_once(Scalar u, std::uint32_t n) {
    for (std::uint32_t k = 0; k < n; ++k) {
        const Scalar x = uniform_jittered(u, k, n);
        ASSERT_GE(x, static_cast<Scalar>(k) / static_cast<Scalar>(n)) << u << " " << k << " of " << n;
        ASSERT_LT(x, static_cast<Scalar>(k + 1) / static_cast<Scalar>(n)) << u << " " << k << " of " << n;
    }
}

TEST(UniformJittered, HitsEachStratumOnce) {
    for (const std::uint32_t n : {1u, 2u, 3u, 7u, 16u, 49u, 100u, 1000u, 4096u, 10007u, 1u << 20}) {
        for (const float u : {0.0f, 0x1p-24f, 0.3f, 0.5f, 0.999f, 1 - 0x1p-24f}) expect_strata_hit_once(u, n);
        expect_strata_hit_once(1 - std::numeric_limits<double>::epsilon() / 2, n);
    }
}

// Shows why uniform_jittered needs its upper bound.
TEST(UniformJittered, PlainFormulaLeavesTheStratum) {
    const float u = 1 - 0x1p-24f;
    EXPECT_EQ((u + 15.0f) / 16.0f, 1.0f);
    EXPECT_LT(uniform_jittered(u, 15, 16), 1.0f);
}

TEST(UniformJittered, IsTheFormulaToRounding) {
    for (std::uint32_t k = 0; k < 37; ++k) EXPECT_NEAR(uniform_jittered(0.25f, k, 37), (k + 0.25) / 37, 6e-8);
}

} // namespace
