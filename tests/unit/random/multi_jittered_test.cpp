/// Tests of permutations by hashes: each result is a permutation, and all permutations are equally likely.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/random/multi_jittered.h>
#include <nusselt/random/pcg.h>

#include "random_statistics.h"

namespace {

using nusselt::pcg4d;
using nusselt::Permutation;
using nusselt::StratumGrid;
using nusselt::test::chi_square_p_value;

std::uint32_t key_of(std::uint32_t number) { return pcg4d({number, 7, 1, 3}).y; }

TEST(Permutation, ReachesEachNumberOnce) {
    for (const std::uint32_t n : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 31u, 32u, 33u, 100u, 1000u, 65537u}) {
        const Permutation permutation(n);
        for (std::uint32_t k = 0; k < 20; ++k) {
            std::vector<int> hits(n);
            for (std::uint32_t i = 0; i < n; ++i) ++hits[permutation(i, key_of(k))];
            EXPECT_EQ(hits, std::vector<int>(n, 1)) << n;
        }
    }
}

TEST(Permutation, IsOneForAllSizes) {
    for (std::uint32_t n = 1; n <= 300; ++n) {
        std::vector<int> hits(n);
        for (std::uint32_t i = 0; i < n; ++i) ++hits[Permutation(n)(i, key_of(n))];
        EXPECT_EQ(hits, std::vector<int>(n, 1)) << n;
    }
}

/// p-value of the hypothesis that all permutations of a few numbers are equally likely.
double p_value_of_all(std::uint32_t n, std::size_t permutations) {
    constexpr std::uint32_t kKeys = 200000;
    std::map<std::vector<std::uint32_t>, int> counts;
    for (std::uint32_t k = 0; k < kKeys; ++k) {
        std::vector<std::uint32_t> image;
        for (std::uint32_t i = 0; i < n; ++i) image.push_back(Permutation(n)(i, key_of(k)));
        ++counts[image];
    }
    const double expected = static_cast<double>(kKeys) / static_cast<double>(permutations);
    double statistic = expected * static_cast<double>(permutations - counts.size());
    for (const auto& [image, count] : counts) statistic += (count - expected) * (count - expected) / expected;
    return chi_square_p_value(statistic, static_cast<double>(permutations - 1));
}

TEST(Permutation, AllOfFewNumbersAreEquallyLikely) {
    EXPECT_GT(p_value_of_all(3, 6), 1e-3 / 4);
    EXPECT_GT(p_value_of_all(4, 24), 1e-3 / 4);
    EXPECT_GT(p_value_of_all(5, 120), 1e-3 / 4);
    EXPECT_GT(p_value_of_all(6, 720), 1e-3 / 4);
}

TEST(Permutation, IndicesGoEverywhere) {
    constexpr std::uint32_t kKeys = 2000000;
    for (const std::uint32_t n : {2u, 3u, 4u, 5u, 12u, 16u, 27u}) {
        std::vector<int> counts(n);
        for (std::uint32_t k = 0; k < kKeys; ++k) ++counts[Permutation(n)(n / 2, key_of(k))];
        const double expected = static_cast<double>(kKeys) / n;
        double statistic = 0;
        for (const int count : counts) statistic += (count - expected) * (count - expected) / expected;
        EXPECT_GT(chi_square_p_value(statistic, n - 1.0), 1e-4) << n;
    }
}

/// p-value of the hypothesis that a pair of indices maps to all pairs of different numbers with equal probability.
double p_value_of_pair(std::uint32_t n, std::uint32_t first, std::uint32_t second) {
    constexpr std::uint32_t kKeys = 400000;
    std::vector<int> counts(n * n);
    for (std::uint32_t k = 0; k < kKeys; ++k)
        ++counts[Permutation(n)(first, key_of(k)) * n + Permutation(n)(second, key_of(k))];
    const double pairs = n * (n - 1.0);
    double statistic = 0;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            if (i != j) {
                const double difference = counts[i * n + j] - kKeys / pairs;
                statistic += difference * difference / (kKeys / pairs);
            }
    return chi_square_p_value(statistic, pairs - 1);
}

TEST(Permutation, PairsGoEverywhere) {
    for (const std::uint32_t n : {8u, 13u, 16u, 30u, 64u}) {
        EXPECT_GT(p_value_of_pair(n, 0, 1), 1e-4) << n;
        EXPECT_GT(p_value_of_pair(n, 2, 3), 1e-4) << n;
        EXPECT_GT(p_value_of_pair(n, 0, n / 2), 1e-4) << n;
    }
}

TEST(StratumGrid, IsAsSquareAsDivisorsAllow) {
    for (std::uint32_t n = 1; n < 3000; ++n) {
        const StratumGrid grid(n);
        ASSERT_EQ(grid.columns * grid.rows, n);
        ASSERT_LE(grid.columns, grid.rows);
        for (std::uint32_t between = grid.columns + 1; between * between <= n; ++between)
            ASSERT_NE(n % between, 0u) << n;
    }
}

TEST(StratumGrid, FindsColumnsExactly) {
    for (const std::uint32_t n : {1u, 7u, 30u, 1021u, 4194301u, 4194304u, 16769025u, 16777216u}) {
        const StratumGrid grid(n);
        for (std::uint32_t cell = 0; cell < n; ++cell) ASSERT_EQ(grid.column_of(cell), cell / grid.rows) << n;
    }
}

} // namespace
