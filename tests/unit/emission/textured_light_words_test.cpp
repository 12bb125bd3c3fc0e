/// Tests of the words that shaders read: tests/parity has the shaders.

#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/emission/textured_light_words.h>

#include "emission/textured_lights.h"

namespace nusselt_test {
namespace {

using nusselt::ShaderLight;
using Words = nusselt::TexturedLightWords;

std::vector<std::uint32_t> words_of(const ShaderLight& light, int most_vertices) {
    std::vector<std::uint32_t> words(static_cast<std::size_t>(Words::count(light)), 0xffffffffu);
    Words::write(light, most_vertices, words.data());
    return words;
}

float number(const std::vector<std::uint32_t>& words, int at) {
    float result = 0;
    std::memcpy(&result, &words[static_cast<std::size_t>(at)], sizeof result);
    return result;
}

StoredLight<float, 8> octagon() {
    static const SquareTexture<float> texture(32, [](int i, int j) { return 1 + i * j % 7; });
    return {nusselt::NearestFilter(), texture.view(), outlines<float>().back()};
}

TEST(TexturedLightWords, HaveEachPartWhereShadersReadIt) {
    const auto stored = octagon();
    const ShaderLight& light = stored.light;
    const auto words = words_of(light, 8);
    // The numbers of shaders/nusselt/emission/textured_light.glsl.
    EXPECT_EQ(words[0], 5u);
    EXPECT_EQ(words[1], 5u);
    EXPECT_EQ(words[2], 3u);
    EXPECT_EQ(words[3], 8u);
    EXPECT_EQ(words[4], static_cast<std::uint32_t>(light.pieces));
    ASSERT_GT(light.pieces, 8);
    EXPECT_EQ(number(words, 21 + 2 * 3 + 1), light.outline.vertex[3].y);
    EXPECT_EQ(number(words, 37 + 2 * 4 + 1), light.column_line[4].high);
    EXPECT_EQ(number(words, 55 + 2 * 4), light.row_line[4].low);
    const float cell[] = {light.weight[27],  light.mean[0][27],   light.mean[1][27],
                          light.mean[2][27], light.variation[27], light.cover[27]};
    for (int k = 0; k < 6; ++k) EXPECT_EQ(number(words, 73 + 6 * 27 + k), cell[k]);
    EXPECT_EQ(words[457 + 4 * 7], static_cast<std::uint32_t>(light.piece[7].cell));
    EXPECT_EQ(number(words, 457 + 4 * 7 + 3), light.piece[7].end);
    for (int level = 0; level < 3; ++level) {
        const auto grid = static_cast<int>(words[static_cast<std::size_t>(5 + level)]);
        const int columns = light.pyramid.shape.width_of(level);
        // Parts of an element are next to each other. The lattice has rows of cells.
        const int place = level < 2 ? 4 * (1 * columns / 2 + 2) + 3 : 3 * columns + 5;
        EXPECT_EQ(number(words, grid + place), light.pyramid.at(level, 5, 3));
    }
    EXPECT_EQ(number(words, static_cast<int>(words.size()) - 1),
              light.pyramid.weight[light.pyramid.shape.size - 1]);
}

/// Shaders cannot sample a part with more vertices than their polygons have.
TEST(TexturedLightWords, MakeCellsWithTooManyVerticesBusy) {
    const auto stored = octagon();
    const ShaderLight& light = stored.light;
    for (const int most : {3, 4, 8}) {
        const auto words = words_of(light, most);
        int busy = 0;
        for (int c = 0; c < ShaderLight::kCells; ++c) {
            const int column = c % 8, row = c / 8;
            const auto part = light.outline.part_in({light.line(column), light.line(row)},
                                                    {light.line(column + 1), light.line(row + 1)});
            const bool fits = light.cover[c] == 1 || part.count <= most;
            busy += !fits;
            EXPECT_EQ(number(words, 73 + 6 * c + 4), fits ? light.variation[c] : 1e30f) << c;
        }
        EXPECT_EQ(busy > 0, most < 8) << most;
    }
}

} // namespace
} // namespace nusselt_test
