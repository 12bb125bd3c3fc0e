#pragma once
/// Lights whose radiance depends on the direction, and their tables, as words of 32 bits, for shaders:
/// shaders/nusselt/emission/windowed_light.glsl and rectified_table.glsl read them.

#include <cstdint>
#include <cstring>
#include <initializer_list>

#include <nusselt/emission/windowed_light.h>

NUSSELT_NAMESPACE_BEGIN

/// The words of a table. Sizes are unsigned, floats are stored as their bits, and integers of 64 bits as two words, the lower
/// half first. Refined texels are left out: shaders take radiance for constant in them.
struct RectifiedTableWords {
    // Where each part begins.
    static constexpr int kWidth = 0;
    static constexpr int kHeight = 1;
    static constexpr int kDomain = 2;    ///< low x and y, high x and y
    static constexpr int kAngleLow = 6;  ///< x and y
    static constexpr int kTexelSize = 8; ///< x and y
    static constexpr int kMean = 10;
    static constexpr int kMeanSquare = 11;
    static constexpr int kSums =
        12; ///< weight, square and solid angle of each entry, then the colours of all entries
    static constexpr int kSumWords = 6;
    static constexpr int kColourWords = 3;

    /// Number of words: about nine per texel.
    NUSSELT_HD static int count(const RectifiedTable<float>& table) noexcept {
        return kSums + (kSumWords + kColourWords) * entries(table);
    }

    /// \param table made by make_rectified_table().
    /// \param words count(table) of them, to be written.
    NUSSELT_HD static void write(const RectifiedTable<float>& table, std::uint32_t* words) noexcept {
        words[kWidth] = static_cast<std::uint32_t>(table.width);
        words[kHeight] = static_cast<std::uint32_t>(table.height);
        const float numbers[] = {table.domain.low.x,  table.domain.low.y, table.domain.high.x,
                                 table.domain.high.y, table.angle_low.x,  table.angle_low.y,
                                 table.texel_size.x,  table.texel_size.y, table.mean,
                                 table.mean_square};
        std::memcpy(words + kDomain, numbers, sizeof numbers);
        for (int k = 0; k < entries(table); ++k) {
            const RectifiedSums& sums = table.sums[k];
            std::uint32_t* next = words + kSums + kSumWords * k;
            for (const std::int64_t sum : {sums.weight, sums.square, sums.solid_angle}) {
                *next++ = static_cast<std::uint32_t>(sum & 0xffffffff);
                *next++ = static_cast<std::uint32_t>(sum >> 32);
            }
        }
        std::uint32_t* colours = words + kSums + kSumWords * entries(table);
        for (int k = 0; k < entries(table); ++k) {
            const float colour[] = {table.colour[k].x, table.colour[k].y, table.colour[k].z};
            std::memcpy(colours + kColourWords * k, colour, sizeof colour);
        }
    }

private:
    NUSSELT_HD static int entries(const RectifiedTable<float>& table) noexcept {
        return RectifiedTable<float>::size(table.width, table.height);
    }
};

/// The words of a light, without its table. Integers are unsigned, floats are stored as their bits.
struct WindowedLightWords {
    // Where each part begins.
    static constexpr int kTable = 0; ///< the first word of the table
    static constexpr int kVertices = 1;
    static constexpr int kCorner = 2;   ///< of the plane in world space
    static constexpr int kFrame = 5;    ///< of the plane: its three axes in world space
    static constexpr int kOutline = 14; ///< x and y of each vertex
    static constexpr int kCount = kOutline + 2 * TextureOutline<float>::kMostVertices; ///< number of words

    /// \param light made by make_portal() or make_profiled_light().
    /// \param table where the words of its table begin. Lights may share tables.
    /// \param words kCount of them, to be written.
    NUSSELT_HD static void write(const WindowedLight<float>& light, std::uint32_t table,
                                 std::uint32_t* words) noexcept {
        words[kTable] = table;
        words[kVertices] = static_cast<std::uint32_t>(light.outline.count);
        int at = kCorner;
        for (const Vec3<float>& v :
             {light.plane.corner, light.plane.frame.t, light.plane.frame.b, light.plane.frame.n}) {
            const float components[] = {v.x, v.y, v.z};
            std::memcpy(words + at, components, sizeof components);
            at += 3;
        }
        for (int k = 0; k < TextureOutline<float>::kMostVertices; ++k) {
            const Vec2<float> vertex = k < light.outline.count ? light.outline.vertex[k] : Vec2<float>{0, 0};
            const float components[] = {vertex.x, vertex.y};
            std::memcpy(words + kOutline + 2 * k, components, sizeof components);
        }
    }
};

NUSSELT_NAMESPACE_END
