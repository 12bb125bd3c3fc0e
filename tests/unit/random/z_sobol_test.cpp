/// Tests of the hierarchical ordering of pixels.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/random/light_random.h>
#include <nusselt/random/z_sobol.h>

namespace {

using nusselt::light_random;
using nusselt::pcg4d;
using nusselt::PixelHierarchy;
using nusselt::Sampler;
using nusselt::Vec2;
using nusselt::z_order;

TEST(ZOrder, AlternatesBits) {
    EXPECT_EQ(z_order(0, 0), 0u);
    EXPECT_EQ(z_order(1, 0), 1u);
    EXPECT_EQ(z_order(0, 1), 2u);
    EXPECT_EQ(z_order(0b101, 0b011), 0b011011u);
    EXPECT_EQ(z_order(0xffff, 0), 0x55555555u);
    EXPECT_EQ(z_order(0xffff, 0xffff), 0xffffffffu);
}

TEST(PixelHierarchy, HasAsManyLevelsAsIndicesHaveRoomFor) {
    const struct {
        std::uint32_t samples, sample_bits, levels;
    } cases[] = {{1, 0, 8},
                 {2, 1, 8},
                 {3, 2, 8},
                 {4, 2, 8},
                 {5, 3, 8},
                 {1u << 16, 16, 8},
                 {(1u << 16) + 1, 17, 7},
                 {1u << 22, 22, 5},
                 {(1u << 31) - 1, 31, 0},
                 {1u << 31, 31, 0}};
    for (const auto& one : cases) {
        const PixelHierarchy hierarchy(one.samples);
        EXPECT_EQ(hierarchy.sample_bits, one.sample_bits) << one.samples;
        EXPECT_EQ(hierarchy.levels, one.levels) << one.samples;
    }
}

TEST(PixelHierarchy, EachSquareOfPixelsHasABlockOfIndices) {
    for (const std::uint32_t samples : {1u, 4u, 1u << 18, 1u << 22}) {
        const PixelHierarchy hierarchy(samples);
        const std::uint32_t side = 1u << hierarchy.levels;
        for (std::uint32_t level = 0; level <= hierarchy.levels; ++level) {
            std::map<std::uint32_t, std::set<std::uint64_t>> blocks_of_squares;
            for (std::uint32_t y = 0; y < side; ++y)
                for (std::uint32_t x = 0; x < side; ++x)
                    blocks_of_squares[(y >> level) * side + (x >> level)].insert(
                        std::uint64_t{
                            hierarchy.index(x + 7 * side, y + 3 * side, samples - 1, 0x12345678u)} >>
                        (hierarchy.sample_bits + 2 * level));
            std::set<std::uint64_t> all;
            for (const auto& [square, blocks] : blocks_of_squares) {
                EXPECT_EQ(blocks.size(), 1u);
                all.insert(*blocks.begin());
            }
            EXPECT_EQ(all.size(), blocks_of_squares.size()) << "two squares share a block";
            EXPECT_EQ(*all.rbegin(), all.size() - 1);
        }
    }
}

/// The positions of four pixels of a square in the order of their samples, after owen_scramble().
int order_of(std::uint32_t square, std::uint32_t seed) {
    const auto key = pcg4d({square, seed, 0, 0});
    const PixelHierarchy hierarchy(1);
    std::array<std::uint32_t, 4> index{};
    for (std::uint32_t i = 0; i < 4; ++i)
        index[i] = nusselt::owen_scramble(hierarchy.index(2 * square + i % 2, i / 2, 0, key.w), key.z);
    int order = 0;
    for (std::size_t i = 0; i < 4; ++i)
        order = 4 * order + static_cast<int>(std::count_if(index.begin(), index.end(),
                                                           [&](auto j) { return j < index[i]; }));
    return order;
}

TEST(PixelHierarchy, AllOrdersOfQuadrantsAreEquallyLikely) {
    constexpr int kTrials = 24000;
    std::map<int, int> counts;
    for (std::uint32_t i = 0; i < kTrials; ++i) ++counts[order_of(i % 100, i)];
    EXPECT_EQ(counts.size(), 24u);
    double statistic = 0;
    for (const auto& [order, count] : counts)
        statistic += (count - kTrials / 24.0) * (count - kTrials / 24.0) / (kTrials / 24.0);
    // 1e-4 quantile of 23 degrees of freedom.
    EXPECT_LT(statistic, 58.6);
}

TEST(PixelHierarchy, OrdersOfSquaresAreIndependent) {
    // Which pixel comes first in one of two neighbouring squares, with the seeds of one tile.
    const auto first = [](std::uint32_t square, std::uint32_t seed) {
        const auto key = pcg4d({0, seed, 1, 0});
        const PixelHierarchy hierarchy(1);
        std::array<std::uint32_t, 4> index{};
        for (std::uint32_t i = 0; i < 4; ++i)
            index[i] = nusselt::owen_scramble(hierarchy.index(2 * square + i % 2, i / 2, 0, key.w), key.z);
        return std::min_element(index.begin(), index.end()) - index.begin();
    };
    for (const std::uint32_t other : {1u, 2u, 77u}) {
        constexpr int kTrials = 16000;
        std::map<std::ptrdiff_t, int> counts;
        for (std::uint32_t seed = 0; seed < kTrials; ++seed)
            ++counts[4 * first(0, seed) + first(other, seed)];
        EXPECT_EQ(counts.size(), 16u);
        double statistic = 0;
        for (const auto& [pair, count] : counts) statistic += (count - 1000.0) * (count - 1000.0) / 1000.0;
        // 1e-4 quantile of 15 degrees of freedom.
        EXPECT_LT(statistic, 44.3) << other;
    }
}

/// Whether points have one each in all boxes of all shapes with area 1 / n, where n = 2^m is their number.
bool is_net(const std::vector<Vec2<float>>& points) {
    int m = 0;
    while ((std::size_t{1} << m) < points.size()) ++m;
    for (int columns = 0; columns <= m; ++columns) {
        std::vector<int> counts(points.size());
        for (const auto& u : points) {
            const auto x = static_cast<std::size_t>(std::ldexp(u.x, columns));
            const auto y = static_cast<std::size_t>(std::ldexp(u.y, m - columns));
            ++counts[(x << (m - columns)) + y];
        }
        if (*std::max_element(counts.begin(), counts.end()) != 1) return false;
    }
    return true;
}

/// The number of aligned squares of 2^k x 2^k pixels whose samples are no net.
int squares_without_net(Sampler kind, std::uint32_t samples, std::uint32_t k) {
    int count = 0;
    for (std::uint32_t square = 0; square < 30; ++square) {
        std::vector<Vec2<float>> points;
        for (std::uint32_t y = 0; y < 1u << k; ++y)
            for (std::uint32_t x = 0; x < 1u << k; ++x)
                for (std::uint32_t i = 0; i < samples; ++i)
                    points.push_back(light_random(kind, 5, (square << k) + x, (3u << k) + y, i, samples, 2));
        count += is_net(points) ? 0 : 1;
    }
    return count;
}

TEST(ZSobol, SquaresOfPixelsHaveNets) {
    for (const std::uint32_t samples : {1u, 2u, 4u, 16u})
        for (std::uint32_t k = 0; k <= 4; ++k)
            EXPECT_EQ(squares_without_net(Sampler::z_sobol, samples, k), 0) << samples << " " << k;
}

/// Mutants: each pixel has points of its own, as nets or at random.
TEST(ZSobol, TestOfNetsRejectsPixelsWithoutOrder) {
    EXPECT_EQ(squares_without_net(Sampler::sobol, 16, 0), 0);
    for (std::uint32_t k = 1; k <= 4; ++k) {
        EXPECT_GE(squares_without_net(Sampler::sobol, 4, k), 29);
        EXPECT_EQ(squares_without_net(Sampler::independent, 4, k), 30);
    }
}

/// Numbers of samples that are no powers of two take the first ones.
TEST(ZSobol, TakesTheFirstOfAPowerOfTwo) {
    for (std::uint32_t i = 0; i < 5; ++i) {
        const auto of_five = light_random(Sampler::z_sobol, 1, 10, 20, i, 5, 0);
        const auto of_eight = light_random(Sampler::z_sobol, 1, 10, 20, i, 8, 0);
        EXPECT_EQ(of_five.x, of_eight.x);
        EXPECT_EQ(of_five.y, of_eight.y);
    }
}

} // namespace
