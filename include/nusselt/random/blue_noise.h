#pragma once
/// Blue noise for dithering, tiled over the screen.
///
/// R. Ulichney 1993, The void-and-cluster method for dither array generation, Proc. SPIE 1913. Neighbouring pixels have
/// different values: the spectrum of an image of values has almost no power in low frequencies, and neither has that of
/// errors that depend smoothly on one value per pixel. C. Peters 2021, BRDF Importance Sampling for Linear Lights,
/// Sec. 5.3, takes one value per pixel, technique and light.

#include <cstddef>
#include <cstdint>

#include <nusselt/random/pcg.h>

NUSSELT_NAMESPACE_BEGIN

/// A view of the bytes of a file of blue noise, such as data/blue-noise.bin. The file has no header: it consists of
/// kChannels squares of kSide x kSide ranks of 16 bits, little-endian, row by row. Each square is a permutation of the
/// numbers below kRanks.
struct BlueNoiseView {
    static constexpr std::uint32_t kSideBits = 6;
    static constexpr std::uint32_t kSide = 1u << kSideBits; ///< [pixels]
    static constexpr std::uint32_t kRankBits = 2 * kSideBits;
    static constexpr std::uint32_t kRanks = 1u << kRankBits;
    static constexpr std::uint32_t kPairBits = 2;
    static constexpr std::uint32_t kChannels =
        2u << kPairBits; ///< pairs of squares that are independent of each other
    static constexpr std::size_t kBytes = 2 * kChannels * kRanks;

    const unsigned char* bytes = nullptr; ///< kBytes of them

    /// \param index below kChannels * kRanks.
    NUSSELT_HD constexpr std::uint32_t rank(std::uint32_t index) const noexcept {
        return bytes[2 * index] | static_cast<std::uint32_t>(bytes[2 * index + 1]) << 8;
    }
};

/// How a stream of random numbers uses blue noise: one square for x and another one for y, each shifted at random. Over
/// all shifts, a pixel gets all pairs of ranks equally often.
struct BlueNoiseShift {
    struct Axis {
        std::uint32_t begin; ///< the index of the first rank of the square
        std::uint32_t column, row;

        /// The index of the rank of a pixel.
        NUSSELT_HD constexpr std::uint32_t index(std::uint32_t pixel_x,
                                                 std::uint32_t pixel_y) const noexcept {
            constexpr std::uint32_t kMask = BlueNoiseView::kSide - 1;
            return begin + ((pixel_y + row) & kMask) * BlueNoiseView::kSide + ((pixel_x + column) & kMask);
        }
    };
    Axis x, y;

    /// \param key random in all bits.
    NUSSELT_HD explicit constexpr BlueNoiseShift(const UInt4& key) noexcept
        : x{square(key.x, 0), offset(key.x), offset(key.y)},
          y{square(key.x, 1), offset(key.z), offset(key.w)} {}

private:
    NUSSELT_HD static constexpr std::uint32_t offset(std::uint32_t word) noexcept {
        return word >> (32 - BlueNoiseView::kSideBits);
    }
    NUSSELT_HD static constexpr std::uint32_t square(std::uint32_t word, std::uint32_t of_pair) noexcept {
        constexpr std::uint32_t kBelowOffset = 32 - BlueNoiseView::kSideBits - BlueNoiseView::kPairBits;
        const std::uint32_t pair = (word >> kBelowOffset) & ((1u << BlueNoiseView::kPairBits) - 1);
        return (2 * pair + of_pair) * BlueNoiseView::kRanks;
    }
};

/// A number whose high bits are a rank, in units of 2^-32. \param low random in its high bits, for what is below a rank.
NUSSELT_HD constexpr std::uint32_t blue_noise_bits(std::uint32_t rank, std::uint32_t low) noexcept {
    return rank << (32 - BlueNoiseView::kRankBits) | low >> BlueNoiseView::kRankBits;
}

NUSSELT_NAMESPACE_END
