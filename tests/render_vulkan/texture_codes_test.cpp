/// Codes of textures stand for exactly the numbers that were there.

#include "render_vulkan/texture_codes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace nusselt::render_vulkan_test {
namespace {

using render_vulkan::TextureCodes;

/// Numbers from a list of `values` different ones, each of which occurs if there are as many numbers.
scene::Texture make_texture(int width, int height, int channels, std::size_t values) {
    std::mt19937 random(1);
    std::vector<float> list = {0.0f, -0.0f, std::numeric_limits<float>::denorm_min(),
                               std::numeric_limits<float>::max()};
    for (std::size_t i = list.size(); i < values; ++i)
        list.push_back(
            static_cast<float>(std::pow(static_cast<double>(i) / static_cast<double>(values), 2.2)));
    scene::Texture texture{.width = width, .height = height, .channels = channels};
    const auto count = static_cast<std::size_t>(width * height * channels);
    for (std::size_t i = 0; i < count; ++i)
        texture.texels.push_back(list[i < values ? i : random() % values]);
    std::shuffle(texture.texels.begin(), texture.texels.end(), random);
    return texture;
}

/// The bits of a number of the texture, as shaders find them.
std::uint32_t decode(const TextureCodes& codes, const std::vector<std::byte>& packed, std::size_t index) {
    const std::size_t size = std::size_t{4} >> codes.packing;
    std::uint32_t code = 0;
    std::memcpy(&code, packed.data() + size * index, size);
    return codes.packing == 0 ? code : codes.values.at(code);
}

void expect_lossless(const scene::Texture& texture, std::uint32_t packing) {
    const TextureCodes codes = render_vulkan::encode_texels(texture.texels);
    EXPECT_EQ(codes.packing, packing);
    const auto from = static_cast<std::size_t>(texture.channels);
    for (const std::size_t to : {from, std::size_t{4}}) {
        const std::vector<std::byte> packed = packed_codes(texture, codes, static_cast<int>(to));
        ASSERT_EQ(packed.size(), texture.texels.size() / from * to * (4u >> packing));
        for (std::size_t i = 0; i < texture.texels.size(); ++i)
            ASSERT_EQ(decode(codes, packed, i / from * to + i % from),
                      std::bit_cast<std::uint32_t>(texture.texels[i]));
    }
}

TEST(TextureCodes, OfFewValues_HaveEightBits) {
    expect_lossless(make_texture(64, 32, 3, 256), 2);
    expect_lossless(make_texture(31, 17, 1, 200), 2);
    expect_lossless(make_texture(4, 2, 1, 4), 2);
}

TEST(TextureCodes, OfMoreValues_HaveSixteenBits) {
    expect_lossless(make_texture(64, 32, 3, 257), 1);
    expect_lossless(make_texture(512, 257, 1, 65536), 1);
}

/// Too many values, or a list that takes more memory than it saves.
TEST(TextureCodes, OfManyValues_AreFloats) {
    expect_lossless(make_texture(512, 300, 1, 65537), 0);
    expect_lossless(make_texture(64, 32, 1, 1025), 0);
    expect_lossless(make_texture(1, 1, 3, 3), 0);
    expect_lossless(make_texture(1, 1, 1, 1), 0);
}

} // namespace
} // namespace nusselt::render_vulkan_test
