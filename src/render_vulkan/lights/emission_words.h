#pragma once
/// The words of emission that varies, for shaders/passes/lights/emission_words.glsl.

#include <nusselt/core/vec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nusselt::render_vulkan {

/// Columns and rows of the lattices of cells that shaders have.
inline constexpr int kShaderCells = 8;

/// Appends zeros. \returns the number of the first one
/// \throws std::runtime_error if 32 bits cannot number all words
std::uint32_t grow_words(std::vector<std::uint32_t>& words, std::size_t count);

/// Appends the bits of numbers. \returns the number of the first word
/// \throws std::runtime_error as grow_words() does
std::uint32_t add_floats(std::span<const float> numbers, std::vector<std::uint32_t>& words);

/// Appends radiance, three words per texel. \returns the number of the first word
/// \throws std::runtime_error as grow_words() does
std::uint32_t add_texels(std::span<const Vec3<float>> texels, std::vector<std::uint32_t>& words);

} // namespace nusselt::render_vulkan
