#pragma once
/// Stores textures in fewer bits without loss.

#include "scene/model/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nusselt::render_vulkan {

/// A code for each number of a texture. Images of eight bits per channel have at most 256 different numbers after
/// decoding, half floats 65536: codes are then indices into a list of these.
struct TextureCodes {
    std::uint32_t packing = 0;         ///< words have 2 to the power of this codes: 1, 2 or 4
    std::vector<std::uint32_t> values; ///< the bits of floats that codes stand for
    std::vector<std::uint16_t>
        codes; ///< empty with packing 0, where codes are the bits of the numbers themselves
};

/// The codes that take the least memory, with their values.
/// \param texels fewer than 2^32 numbers
TextureCodes encode_texels(std::span<const float> texels);

/// Codes as shaders read them, 1, 2 or 4 bytes each: row by row, with the channels of a texel in sequence.
/// \param codes    of this texture
/// \param channels per texel, at least as many as the texture has; further ones are 0
std::vector<std::byte> packed_codes(const scene::Texture& texture, const TextureCodes& codes, int channels);

} // namespace nusselt::render_vulkan
