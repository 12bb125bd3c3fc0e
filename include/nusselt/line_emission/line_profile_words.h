#pragma once
/// The radiance along a light as words of 32 bits, for shaders: shaders/nusselt/line_emission/line_profile.glsl reads them.

#include <cstdint>
#include <cstring>

#include <nusselt/line_emission/line_profile.h>

NUSSELT_NAMESPACE_BEGIN

/// Shaders have room for the cells of 64 texels.
using ShaderLineProfile = LineProfile<float, 64>;

/// The words of a profile. Integers are unsigned, floats are stored as their bits.
struct LineProfileWords {
    // Where each part begins.
    static constexpr int kCells = 0;   ///< their number
    static constexpr int kBorders = 1; ///< position, integral up to there, radiance of each channel
    static constexpr int kBorderWords = 5;

    /// Number of words.
    NUSSELT_HD static int count(const ShaderLineProfile& profile) noexcept {
        return kBorders + kBorderWords * (profile.cells + 1);
    }

    /// \param words count(profile) of them, to be written.
    NUSSELT_HD static void write(const ShaderLineProfile& profile, std::uint32_t* words) noexcept {
        words[kCells] = static_cast<std::uint32_t>(profile.cells);
        for (int k = 0; k <= profile.cells; ++k) {
            const float numbers[kBorderWords] = {profile.border[k], profile.before[k], profile.radiance[0][k],
                                                 profile.radiance[1][k], profile.radiance[2][k]};
            std::memcpy(words + kBorders + kBorderWords * k, numbers, sizeof numbers);
        }
    }
};

NUSSELT_NAMESPACE_END
