/// Blue noise by the void-and-cluster method; tests/unit/random has those of its spectrum.

#include "fit/void_and_cluster.h"
#include "tables/blue_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace nusselt::fit {
namespace {

/// Also the test that results do not depend on the machine.
TEST(VoidAndCluster, MakesWhatShips) {
    const std::string_view shipped(reinterpret_cast<const char*>(tables::blue_noise().bytes),
                                   BlueNoiseView::kBytes);
    EXPECT_EQ(make_blue_noise(1.5, 0), shipped);
    EXPECT_NE(make_blue_noise(1.5, 1), shipped);
    EXPECT_NE(make_blue_noise(1.6, 0), shipped);
}

TEST(VoidAndCluster, RanksArePermutations) {
    for (const int side : {2, 3, 7, 16}) {
        auto ranks = void_and_cluster(side, 1.5, 3);
        std::sort(ranks.begin(), ranks.end());
        ASSERT_EQ(ranks.size(), static_cast<std::size_t>(side * side));
        for (std::size_t i = 0; i < ranks.size(); ++i) EXPECT_EQ(ranks[i], i) << side;
    }
}

/// The smallest squared distance between two pixels with ranks below a limit, in a square that repeats.
int smallest_distance(const std::vector<std::uint16_t>& ranks, int side, int limit) {
    int smallest = side * side;
    const auto along = [side](int d) { return std::min(std::abs(d), side - std::abs(d)); };
    for (int i = 0; i < side * side; ++i)
        for (int j = 0; j < i; ++j)
            if (ranks[static_cast<std::size_t>(i)] < limit && ranks[static_cast<std::size_t>(j)] < limit) {
                const int dx = along(i % side - j % side), dy = along(i / side - j / side);
                smallest = std::min(smallest, dx * dx + dy * dy);
            }
    return smallest;
}

/// A sixteenth of the pixels could be 4.3 pixels apart. At random, some are neighbours.
TEST(VoidAndCluster, LowestRanksAreApart_AlsoAcrossTheEdges) {
    int rejected = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        auto ranks = void_and_cluster(32, 1.5, seed);
        EXPECT_GE(smallest_distance(ranks, 32, 64), 8) << seed;
        // Mutant: the halves of columns on the right change places, so that rows do not meet those on the left.
        for (std::size_t i = 0; i < 16; ++i)
            std::swap_ranges(&ranks[32 * i + 16], &ranks[32 * i + 16] + 16, &ranks[32 * (i + 16) + 16]);
        rejected += smallest_distance(ranks, 32, 64) < 8 ? 1 : 0;
    }
    EXPECT_GE(rejected, 8);
}

} // namespace
} // namespace nusselt::fit
