#pragma once
/// Hierarchical ordering of pixels: all pixels of a tile share one sequence of Sobol' points.
///
/// A. Ahmed, P. Wonka 2020, Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of
/// Pixels, ACM Transactions on Graphics 39(6). Pixels take consecutive blocks of the sequence along a curve that visits
/// the quadrants of each square of a quadtree one after the other, in random order. Thus, an aligned square of pixels has
/// an aligned block of the sequence, which is a (0, m, 2)-net. Errors of neighbours cancel: the spectrum of an image of
/// errors has little power in low frequencies. M. Pharr, W. Jakob, G. Humphreys 2023, Physically Based Rendering,
/// Sec. 8.7 calls this the Z-Sobol' sampler.
///
/// There, each node of the quadtree has one of the 24 permutations of its quadrants. Here, owen_scramble() of the index
/// swaps halves and quarters of each block, which makes 8 of them, and a hash of the node chooses which quadrants form the
/// halves, one of three ways. Each of the 24 results from one of these choices. The quadtree has at most kMostLevels: tiles
/// are independent of each other, since all that remains is noise as coarse as they are.

#include <cstdint>

#include <nusselt/random/sobol.h>

NUSSELT_NAMESPACE_BEGIN

/// The position of a pixel along the Z curve: bits of x and y alternate, that of x is the lower one.
/// \param x, y below 2^16.
NUSSELT_HD constexpr std::uint32_t z_order(std::uint32_t x, std::uint32_t y) noexcept {
    std::uint32_t spread[2] = {x, y};
    for (std::uint32_t& bits : spread) {
        bits = (bits | bits << 8) & 0x00ff00ffu;
        bits = (bits | bits << 4) & 0x0f0f0f0fu;
        bits = (bits | bits << 2) & 0x33333333u;
        bits = (bits | bits << 1) & 0x55555555u;
    }
    return spread[0] | spread[1] << 1;
}

/// The quadtree over the pixels of a tile, and the blocks of a sequence that they take.
struct PixelHierarchy {
    static constexpr std::uint32_t kMostLevels = 8;

    std::uint32_t sample_bits = 0; ///< a pixel has 2^sample_bits indices
    std::uint32_t levels;          ///< a tile has 2^levels x 2^levels pixels

    /// \param sample_count 1 to 2^31. A pixel takes the first ones of a power of two of points.
    NUSSELT_HD explicit constexpr PixelHierarchy(std::uint32_t sample_count) noexcept : levels(kMostLevels) {
        while (sample_bits < 31 && ((sample_count - 1) >> sample_bits) != 0) ++sample_bits;
        if (levels > (32 - sample_bits) / 2) levels = (32 - sample_bits) / 2;
    }

    /// The number of a pixel in its tile along the Z curve.
    NUSSELT_HD constexpr std::uint32_t number(std::uint32_t x, std::uint32_t y) const noexcept {
        const std::uint32_t mask = (1u << levels) - 1;
        return z_order(x & mask, y & mask);
    }

    /// Two bits of the rank of a pixel: the position of its quadrant among the four of a square.
    /// \param number see number().
    /// \param level  of the quadtree, 0 for single pixels.
    /// \param seed   random in all bits.
    NUSSELT_HD constexpr std::uint32_t digit(std::uint32_t number, std::uint32_t level,
                                             std::uint32_t seed) const noexcept {
        // The path to the square, below a bit for the root.
        const std::uint32_t node = number >> 2 * level >> 2 | 1u << 2 * (levels - 1 - level);
        // Quadrant 0 stays. The others turn by 0 to 2, so that each of them comes to form a half with quadrant 0.
        const std::uint32_t turn = ((hash(node ^ seed) >> 16) * 3) >> 16;
        const std::uint32_t quadrant = (number >> 2 * level) & 3u;
        const std::uint32_t turned = quadrant + turn;
        return quadrant == 0 ? 0 : turned > 3 ? turned - 3 : turned;
    }

    /// The index of a sample in the sequence of its tile.
    /// \param rank of the pixel: its digit() for each level, the lowest level last.
    NUSSELT_HD constexpr std::uint32_t index(std::uint32_t rank, std::uint32_t sample) const noexcept {
        return rank << sample_bits | sample;
    }

    NUSSELT_HD constexpr std::uint32_t index(std::uint32_t x, std::uint32_t y, std::uint32_t sample,
                                             std::uint32_t seed) const noexcept {
        const std::uint32_t n = number(x, y);
        std::uint32_t rank = 0;
        for (std::uint32_t level = levels; level-- > 0;) rank = 4 * rank + digit(n, level, seed);
        return index(rank, sample);
    }

private:
    /// The finalizer of MurmurHash3 by A. Appleby: a bijection.
    NUSSELT_HD static constexpr std::uint32_t hash(std::uint32_t x) noexcept {
        x = (x ^ (x >> 16)) * 0x85ebca6bu;
        x = (x ^ (x >> 13)) * 0xc2b2ae35u;
        return x ^ (x >> 16);
    }
};

/// The seeds of a tile; random in all bits.
struct ZSobolSeeds {
    SobolSeeds points;
    std::uint32_t quadrants;
};

/// Sample of a pixel: in each aligned square of 2^k x 2^k pixels of a tile, the samples form a (0, m, 2)-net if their
/// number per pixel is a power of two.
/// \param sample below the number of samples that the hierarchy was made for.
NUSSELT_HD constexpr UInt2 z_sobol(const PixelHierarchy& hierarchy, std::uint32_t x, std::uint32_t y,
                                   std::uint32_t sample, const ZSobolSeeds& seeds) noexcept {
    return owen_scrambled_sobol(hierarchy.index(x, y, sample, seeds.quadrants), seeds.points);
}

NUSSELT_NAMESPACE_END
