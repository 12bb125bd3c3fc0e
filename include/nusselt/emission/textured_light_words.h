#pragma once
/// A light with a texture as words of 32 bits, for shaders: shaders/nusselt/emission/textured_light.glsl reads them.

#include <cstdint>
#include <cstring>

#include <nusselt/emission/textured_light.h>

NUSSELT_NAMESPACE_BEGIN

/// Shaders have 8 x 8 cells: 256 weights per shading point are too many for them.
using ShaderLight = TexturedLight<float, 8>;

/// The words of a light. Integers are unsigned, floats are stored as their bits.
struct TexturedLightWords {
    // Where each part begins.
    static constexpr int kWidthLog2 = 0; ///< of the finest grid
    static constexpr int kHeightLog2 = 1;
    static constexpr int kLevels = 2;
    static constexpr int kVertices = 3;
    static constexpr int kPieces = 4;
    static constexpr int kGrids = 5; ///< for each level, the word where its grid begins
    static constexpr int kOutline = kGrids + PyramidShape::kMostLevels; ///< x and y of each vertex
    static constexpr int kColumnLines =
        kOutline + 2 * TextureOutline<float>::kMostVertices; ///< low and high of each chord
    static constexpr int kRowLines = kColumnLines + 2 * 9;   ///< likewise
    static constexpr int kCells = kRowLines + 2 * 9; ///< weight, mean of each channel, variation, cover
    static constexpr int kCellWords = 6;
    static constexpr int kPieceList = kCells + kCellWords * ShaderLight::kCells; ///< cell, edge, begin, end
    static constexpr int kPieceWords = 4;
    static constexpr int kPyramid = kPieceList + kPieceWords * ShaderLight::kMostPieces;

    /// Number of words.
    NUSSELT_HD static int count(const ShaderLight& light) noexcept {
        return kPyramid + light.pyramid.shape.size;
    }

    /// \param light         prepared by make_textured_light().
    /// \param most_vertices NUSSELT_MAX_VERTICES of the shaders, 3 to 8. Cells whose part inside of the outline has
    ///                      more vertices are always sampled by texels.
    /// \param words         count(light) of them, to be written.
    NUSSELT_HD static void write(const ShaderLight& light, int most_vertices, std::uint32_t* words) noexcept {
        const PyramidShape& shape = light.pyramid.shape;
        for (int i = 0; i < kPyramid; ++i) words[i] = 0;
        words[kWidthLog2] = word(shape.width_log2);
        words[kHeightLog2] = word(shape.height_log2);
        words[kLevels] = word(shape.levels);
        words[kVertices] = word(light.outline.count);
        words[kPieces] = word(light.pieces);
        for (int level = 0; level < shape.levels; ++level)
            words[kGrids + level] = word(kPyramid + shape.offset[level]);
        for (int k = 0; k < light.outline.count; ++k)
            put(words + kOutline + 2 * k, light.outline.vertex[k].x, light.outline.vertex[k].y);
        for (int i = 0; i <= 8; ++i) {
            put(words + kColumnLines + 2 * i, light.column_line[i].low, light.column_line[i].high);
            put(words + kRowLines + 2 * i, light.row_line[i].low, light.row_line[i].high);
        }
        for (int c = 0; c < ShaderLight::kCells; ++c) {
            std::uint32_t* cell = words + kCells + kCellWords * c;
            put(cell, light.weight[c], light.mean[0][c], light.mean[1][c], light.mean[2][c],
                variation_of(light, c, most_vertices), light.cover[c]);
        }
        for (int k = 0; k < light.pieces; ++k) {
            std::uint32_t* piece = words + kPieceList + kPieceWords * k;
            piece[0] = word(light.piece[k].cell);
            piece[1] = word(light.piece[k].edge);
            put(piece + 2, light.piece[k].begin, light.piece[k].end);
        }
        for (int i = 0; i < shape.size; ++i) put(words + kPyramid + i, light.pyramid.weight[i]);
    }

private:
    NUSSELT_HD static std::uint32_t word(int x) noexcept { return static_cast<std::uint32_t>(x); }

    template <class... Floats>
    NUSSELT_HD static void put(std::uint32_t* words, const Floats&... numbers) noexcept {
        const float values[] = {numbers...};
        std::memcpy(words, values, sizeof values);
    }

    /// Products with the largest one stay in range.
    NUSSELT_HD static float variation_of(const ShaderLight& light, int cell, int most_vertices) noexcept {
        constexpr float kMost = 1e30f;
        if (light.cover[cell] < 1) {
            const int column = cell % 8, row = cell / 8;
            const TexturePart<float> part = light.outline.part_in(
                {light.line(column), light.line(row)}, {light.line(column + 1), light.line(row + 1)});
            if (part.count > most_vertices) return kMost;
        }
        return min(light.variation[cell], kMost);
    }
};

NUSSELT_NAMESPACE_END
