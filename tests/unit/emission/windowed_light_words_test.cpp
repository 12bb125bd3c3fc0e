/// Tests of the words of lights and tables that shaders read: tests/parity has the shaders.

#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/emission/windowed_light_words.h>

#include "emission/windowed_lights.h"

namespace nusselt_test {
namespace {

using nusselt::RectifiedSums;
using nusselt::RectifiedTableWords;
using nusselt::WindowedLightWords;

float number(const std::vector<std::uint32_t>& words, int at) {
    float result = 0;
    std::memcpy(&result, &words[static_cast<std::size_t>(at)], sizeof result);
    return result;
}

std::int64_t integer(const std::vector<std::uint32_t>& words, int at) {
    const auto word = [&](int i) { return std::int64_t{words[static_cast<std::size_t>(i)]}; };
    return word(at) + word(at + 1) * (std::int64_t{1} << 32);
}

TEST(RectifiedTableWords, HaveEachPartWhereShadersReadIt) {
    const StoredTable<float> stored(
        [](const nusselt::Vec3<float>& w) {
            return nusselt::Vec3<float>{1 + w.x, 2, 3 + w.y};
        },
        {{-0.5f, -1}, {0.75f, 2}}, 5, 7, 1);
    const auto& table = stored.table;
    std::vector<std::uint32_t> words(static_cast<std::size_t>(RectifiedTableWords::count(table)),
                                     0xffffffffu);
    RectifiedTableWords::write(table, words.data());
    // The numbers of shaders/nusselt/emission/rectified_table.glsl.
    EXPECT_EQ(words[0], 5u);
    EXPECT_EQ(words[1], 7u);
    EXPECT_EQ(number(words, 2), -0.5f);
    EXPECT_EQ(number(words, 3), -1);
    EXPECT_EQ(number(words, 4), 0.75f);
    EXPECT_EQ(number(words, 5), 2);
    EXPECT_EQ(number(words, 6), table.angle_low.x);
    EXPECT_EQ(number(words, 9), table.texel_size.y);
    EXPECT_EQ(number(words, 10), table.mean);
    EXPECT_EQ(number(words, 11), table.mean_square);
    for (int j = 0; j <= 7; ++j) {
        for (int i = 0; i <= 5; ++i) {
            const int entry = j * 6 + i;
            const RectifiedSums& sums = table.sums[table.index(i, j)];
            EXPECT_EQ(integer(words, 12 + 6 * entry), sums.weight);
            EXPECT_EQ(integer(words, 12 + 6 * entry + 2), sums.square);
            EXPECT_EQ(integer(words, 12 + 6 * entry + 4), sums.solid_angle);
            EXPECT_EQ(number(words, 12 + 6 * 48 + 3 * entry + 1), table.colour[table.index(i, j)].y);
        }
    }
    EXPECT_GT(words[words.size() - 48 * 3 - 1], 0u) << "sums exceed 32 bits";
    EXPECT_EQ(number(words, static_cast<int>(words.size()) - 1), stored.colour.back().z);
}

TEST(WindowedLightWords, HaveEachPartWhereShadersReadIt) {
    const auto stored = table_of<float>(TexelMap(4, [](const auto&) { return 1; }));
    const std::vector<nusselt::Vec3<float>> triangle = {{1, 2, 3}, {2, 2, 3}, {1, 4, 3}};
    const auto light = portal_of(triangle, stored.table);
    std::vector<std::uint32_t> words(static_cast<std::size_t>(WindowedLightWords::kCount), 0xffffffffu);
    WindowedLightWords::write(light, 1234, words.data());
    // The numbers of shaders/nusselt/emission/windowed_light.glsl.
    EXPECT_EQ(words[0], 1234u);
    EXPECT_EQ(words[1], 3u);
    EXPECT_EQ(number(words, 2), light.plane.corner.x);
    EXPECT_EQ(number(words, 4), light.plane.corner.z);
    EXPECT_EQ(number(words, 5), light.plane.frame.t.x);
    EXPECT_EQ(number(words, 9), light.plane.frame.b.y);
    EXPECT_EQ(number(words, 13), light.plane.frame.n.z);
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(number(words, 14 + 2 * k), light.outline.vertex[k].x);
        EXPECT_EQ(number(words, 15 + 2 * k), light.outline.vertex[k].y);
    }
    EXPECT_EQ(words[29], 0u);
}

} // namespace
} // namespace nusselt_test
