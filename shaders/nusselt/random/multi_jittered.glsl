#ifndef NUSSELT_RANDOM_MULTI_JITTERED_GLSL
#define NUSSELT_RANDOM_MULTI_JITTERED_GLSL
// Follows include/nusselt/random/multi_jittered.h @ 3e03be7c2b76
/// Permutations that are functions of a hash, and multi-jittered points. Twin of
/// include/nusselt/random/multi_jittered.h, where the sources stand. The same bits as there.

#include "../random/unit_interval.glsl"

/// A family of permutations of [0, n).
struct Permutation {
    uint n;
    uint bits; ///< of n - 1, at least 1
    uint mask; ///< that many ones
};

/// \param n at least 1.
Permutation make_permutation(uint n) {
    uint bits = 1u;
    while (bits < 32u && ((n - 1u) >> bits) != 0u) ++bits;
    return Permutation(n, bits, 0xffffffffu >> (32u - bits));
}

/// Each step is a bijection of the numbers up to the mask: who follows the cycle of an index below n comes back to one.
uint permutation_in_power_of_two(const Permutation self, uint index, uint key) {
    // Ten rounds: with fewer, pairs of indices prefer some pairs of images.
    for (int round = 0; round < 10; ++round) {
        // High bits of products are the better ones.
        key = (key ^ (key >> 15)) * 0x9e3779b1u;
        index = ((index ^ (key >> 8)) * ((key >> 16) | 1u)) & self.mask;
        index ^= index >> ((self.bits + 1u) / 2u);
        index = ((index >> 1) | (index << (self.bits - 1u))) & self.mask;
    }
    return index;
}

/// The image of an index.
/// \param index below n.
/// \param key   chooses the permutation; random in all bits.
uint permutation_of(const Permutation self, uint index, uint key) {
    do index = permutation_in_power_of_two(self, index, key);
    while (index >= self.n);
    return index;
}

/// The grid of multi-jittered points.
struct StratumGrid {
    uint columns, rows; ///< columns * rows is the number of points
};

/// The grid is as close to a square as the divisors of n allow. It costs up to sqrt(n) divisions, few for numbers with
/// divisors close to sqrt(n).
/// \param n at least 1.
StratumGrid make_stratum_grid(uint n) {
    uint columns = 0u;
    for (uint bit = 1u << 15; bit > 0u; bit /= 2u)
        if ((columns + bit) * (columns + bit) <= n) columns += bit;
    while (n % columns != 0u) --columns;
    return StratumGrid(columns, n / columns);
}

/// The permutations of a set of multi-jittered points; random in all bits.
struct MultiJitterKeys {
    uint order, in_columns, in_rows;
};

/// Point number index of n: points with the same keys have one each in n strata of x, n of y, and in the cells of
/// make_stratum_grid(n).
/// \param index  below n.
/// \param n      1 to 2^22.
/// \param jitter in [0, 1)^2, independent of that of other points.
vec2 multi_jittered(uint index, uint n, const MultiJitterKeys keys, vec2 jitter) {
    StratumGrid grid = make_stratum_grid(n);
    uint cell = permutation_of(make_permutation(n), index, keys.order);
    uint column = cell / grid.rows;
    uint row = cell - column * grid.rows;
    uint x = column * grid.rows + permutation_of(make_permutation(grid.rows), row, keys.in_columns);
    uint y = row * grid.columns + permutation_of(make_permutation(grid.columns), column, keys.in_rows);
    return vec2(uniform_jittered(jitter.x, x, n), uniform_jittered(jitter.y, y, n));
}

#endif
