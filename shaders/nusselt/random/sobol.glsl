#ifndef NUSSELT_RANDOM_SOBOL_GLSL
#define NUSSELT_RANDOM_SOBOL_GLSL
// Follows include/nusselt/random/sobol.h @ fcad869b7efa
/// The first two dimensions of Sobol's sequence and Owen scrambling by hashes. Twin of include/nusselt/random/sobol.h,
/// where the sources stand.

#include "../core/compatibility.glsl"

uint reverse_bits(uint x) {
    x = (x >> 16) | (x << 16);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/// The second coordinate of point number index with its bits reversed.
uint sobol_y_reversed(uint index) {
    index ^= (index >> 16) & 0x0000ffffu;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 2) & 0x33333333u;
    return index ^ ((index >> 1) & 0x55555555u);
}

/// A random permutation that may flip a bit depending on the lower bits, never on higher ones.
/// \param seed should itself be random in all bits.
uint permute_upwards(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

/// Point number index in units of 2^-32, not scrambled.
uvec2 sobol(uint index) { return uvec2(reverse_bits(index), reverse_bits(sobol_y_reversed(index))); }

/// Owen scrambling: swaps the halves of [0, 1) at random, the quarters in each half, and so on.
/// \param x    in units of 2^-32.
/// \param seed should itself be random in all bits, such as the result of pcg4d().
uint owen_scramble(uint x, uint seed) { return reverse_bits(permute_upwards(reverse_bits(x), seed)); }

/// Seeds of one pair of dimensions; random in all bits.
struct SobolSeeds {
    uint order, x, y;
};

/// Point number index of a sequence with scrambled coordinates and order, in units of 2^-32. Aligned blocks of 2^m
/// points remain (0, m, 2)-nets, while pairs of dimensions with different seeds know nothing of each other.
uvec2 owen_scrambled_sobol(uint index, const SobolSeeds seeds) {
    uint shuffled = owen_scramble(index, seeds.order);
    return uvec2(reverse_bits(permute_upwards(shuffled, seeds.x)),
                 reverse_bits(permute_upwards(sobol_y_reversed(shuffled), seeds.y)));
}

#endif
