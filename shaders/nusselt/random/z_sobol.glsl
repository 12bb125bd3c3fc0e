#ifndef NUSSELT_RANDOM_Z_SOBOL_GLSL
#define NUSSELT_RANDOM_Z_SOBOL_GLSL
// Follows include/nusselt/random/z_sobol.h @ 174d050cb8f3
/// Hierarchical ordering of pixels: all pixels of a tile share one sequence of Sobol' points. Twin of
/// include/nusselt/random/z_sobol.h, where the sources stand.

#include "../random/sobol.glsl"

uint z_order_spread(uint bits) {
    bits = (bits | (bits << 8)) & 0x00ff00ffu;
    bits = (bits | (bits << 4)) & 0x0f0f0f0fu;
    bits = (bits | (bits << 2)) & 0x33333333u;
    return (bits | (bits << 1)) & 0x55555555u;
}

/// The position of a pixel along the Z curve: bits of x and y alternate, that of x is the lower one.
/// \param x, y below 2^16.
uint z_order(uint x, uint y) { return z_order_spread(x) | (z_order_spread(y) << 1); }

const uint kNusseltPixelHierarchyMostLevels = 8u;

/// The quadtree over the pixels of a tile, and the blocks of a sequence that they take.
struct PixelHierarchy {
    uint sample_bits; ///< a pixel has 2^sample_bits indices
    uint levels;      ///< a tile has 2^levels x 2^levels pixels
};

/// \param sample_count 1 to 2^31. A pixel takes the first ones of a power of two of points.
PixelHierarchy make_pixel_hierarchy(uint sample_count) {
    uint sample_bits = 0u;
    while (sample_bits < 31u && ((sample_count - 1u) >> sample_bits) != 0u) ++sample_bits;
    return PixelHierarchy(sample_bits, min((32u - sample_bits) / 2u, kNusseltPixelHierarchyMostLevels));
}

/// The finalizer of MurmurHash3 by A. Appleby: a bijection.
uint pixel_hierarchy_hash(uint x) {
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

/// Two bits of the rank of a pixel: the position of its quadrant among the four of a square.
/// \param number of the pixel in its tile along the Z curve.
/// \param level  of the quadtree, 0 for single pixels.
/// \param seed   random in all bits.
uint pixel_hierarchy_digit(const PixelHierarchy self, uint number, uint level, uint seed) {
    // The path to the square, below a bit for the root.
    uint node = ((number >> (2u * level)) >> 2) | (1u << (2u * (self.levels - 1u - level)));
    // Quadrant 0 stays. The others turn by 0 to 2, so that each of them comes to form a half with quadrant 0.
    uint turn = ((pixel_hierarchy_hash(node ^ seed) >> 16) * 3u) >> 16;
    uint quadrant = (number >> (2u * level)) & 3u;
    uint turned = quadrant + turn;
    return quadrant == 0u ? 0u : turned > 3u ? turned - 3u : turned;
}

/// The index of a sample in the sequence of its tile.
/// \param seed random in all bits.
uint pixel_hierarchy_index(const PixelHierarchy self, uint x, uint y, uint index, uint seed) {
    uint mask = (1u << self.levels) - 1u;
    uint number = z_order(x & mask, y & mask);
    uint rank = 0u;
    for (uint level = self.levels; level > 0u; --level)
        rank = 4u * rank + pixel_hierarchy_digit(self, number, level - 1u, seed);
    return (rank << self.sample_bits) | index;
}

/// The seeds of a tile; random in all bits.
struct ZSobolSeeds {
    SobolSeeds points;
    uint quadrants;
};

/// Sample of a pixel in units of 2^-32: in each aligned square of 2^k x 2^k pixels of a tile, the samples form a
/// (0, m, 2)-net if their number per pixel is a power of two.
/// \param index of the sample, below the number of samples that the hierarchy was made for.
uvec2 z_sobol(const PixelHierarchy hierarchy, uint x, uint y, uint index, const ZSobolSeeds seeds) {
    return owen_scrambled_sobol(pixel_hierarchy_index(hierarchy, x, y, index, seeds.quadrants), seeds.points);
}

#endif
