/// Tests of the words of a map that shaders read: tests/parity has the shaders.

#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/emission/environment_map_words.h>

#include "emission/environments.h"

namespace nusselt_test {
namespace {

using Words = nusselt::EnvironmentMapWords;

float number(const std::vector<std::uint32_t>& words, int at) {
    float result = 0;
    std::memcpy(&result, &words[static_cast<std::size_t>(at)], sizeof result);
    return result;
}

TEST(EnvironmentMapWords, HaveEachPartWhereShadersReadIt) {
    const MapTexels<float> texels(64, [](int i, int j) {
        return nusselt::Vec3<float>{static_cast<float>(1 + i * j % 7), 2, static_cast<float>(i)};
    });
    const StoredMap<float, 8> stored(texels.view());
    const nusselt::ShaderEnvironment& map = stored.map;
    std::vector<std::uint32_t> words(static_cast<std::size_t>(Words::count(map)), 0xffffffffu);
    Words::write(map, words.data());
    // The numbers of shaders/nusselt/emission/environment_map.glsl.
    EXPECT_EQ(words[0], 64u);
    EXPECT_EQ(words[1], 4u);
    EXPECT_EQ(number(words, 2), map.scale);
    EXPECT_EQ(number(words, 3), map.texel_variance);
    for (const int cell : {0, 27, 63}) {
        const int begin = 20 + 28 * (cell / 4) + cell % 4;
        EXPECT_EQ(number(words, begin), map.weight[cell]);
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(number(words, begin + 4 + 4 * k), map.direction[k][cell]);
            EXPECT_EQ(number(words, begin + 16 + 4 * k), map.mean[k][cell]);
        }
    }
    // Element (i, j) of a grid has the four texels below it in grid 1, and 16 numbers in grids 2 and 3.
    const int i = 5, j = 3;
    const auto grid = [&](int level) { return static_cast<int>(words[static_cast<std::size_t>(4 + level)]); };
    EXPECT_EQ(number(words, grid(1) + 4 * (j * 32 + i) + 1), map.texel_weight(2 * i + 1, 2 * j));
    for (const int level : {2, 3})
        for (int k = 0; k < 16; ++k)
            EXPECT_EQ(number(words, grid(level) + 16 * (j * (64 >> level) + i) + k),
                      map.elements[map.element_index(level, i, j) + k]);
    EXPECT_EQ(number(words, static_cast<int>(words.size()) - 1), stored.storage.back());
    // Rows of four numbers are aligned.
    EXPECT_EQ(grid(1) % 4, 0);
}

} // namespace
} // namespace nusselt_test
