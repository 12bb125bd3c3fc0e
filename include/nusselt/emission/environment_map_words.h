#pragma once
/// An environment map as words of 32 bits, for shaders: shaders/nusselt/emission/environment_map.glsl reads them.

#include <cstdint>
#include <cstring>

#include <nusselt/emission/environment_map.h>

NUSSELT_NAMESPACE_BEGIN

/// Shaders have 8 x 8 cells: 256 weights per shading point are too many for them.
using ShaderEnvironment = EnvironmentMap<float, 8>;

/// The words of a map, without its texels. Integers are unsigned, floats are stored as their bits.
struct EnvironmentMapWords {
    // Where each part begins.
    static constexpr int kSize = 0; ///< columns and rows of texels
    static constexpr int kLevels = 1;
    static constexpr int kScale = 2;
    static constexpr int kTexelVariance = 3;
    static constexpr int kGrids = 4; ///< for each level but the first, the word where its grid begins
    /// Four cells of a row together: their weights, coordinates of their directions, mean radiance of each channel.
    static constexpr int kCells = kGrids + PyramidShape::kMostLevels;
    static constexpr int kCellsTogether = 4;
    static constexpr int kCellWords = 7;
    static constexpr int kTexelWeights = kCells + kCellWords * ShaderEnvironment::kCells;

    /// Number of words: about 7/3 per texel.
    NUSSELT_HD static int count(const ShaderEnvironment& map) noexcept {
        return kTexelWeights + ShaderEnvironment::storage_size(map.radiance.size);
    }

    /// \param map   prepared by make_environment_map(); its texels are not read.
    /// \param words count(map) of them, to be written.
    NUSSELT_HD static void write(const ShaderEnvironment& map, std::uint32_t* words) noexcept {
        const PyramidShape& shape = map.shape;
        const int texels = map.radiance.size * map.radiance.size;
        for (int i = 0; i < kTexelWeights; ++i) words[i] = 0;
        words[kSize] = word(map.radiance.size);
        words[kLevels] = word(shape.levels);
        put(words + kScale, &map.scale, 1);
        put(words + kTexelVariance, &map.texel_variance, 1);
        words[kGrids + 1] = word(kTexelWeights);
        for (int level = 2; level < shape.levels; ++level)
            words[kGrids + level] = word(kTexelWeights + texels + map.element_index(level, 0, 0));
        for (int cell = 0; cell < ShaderEnvironment::kCells; cell += kCellsTogether) {
            std::uint32_t* next = words + kCells + kCellWords * cell;
            const float* const numbers[kCellWords] = {map.weight,       map.direction[0], map.direction[1],
                                                      map.direction[2], map.mean[0],      map.mean[1],
                                                      map.mean[2]};
            for (int k = 0; k < kCellWords; ++k)
                put(next + kCellsTogether * k, numbers[k] + cell, kCellsTogether);
        }
        put(words + kTexelWeights, map.texel_weights, texels);
        put(words + kTexelWeights + texels, map.elements, count(map) - kTexelWeights - texels);
    }

private:
    NUSSELT_HD static std::uint32_t word(int x) noexcept { return static_cast<std::uint32_t>(x); }

    NUSSELT_HD static void put(std::uint32_t* words, const float* numbers, int count) noexcept {
        std::memcpy(words, numbers, static_cast<std::size_t>(count) * sizeof(float));
    }
};

NUSSELT_NAMESPACE_END
