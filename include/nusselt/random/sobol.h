#pragma once
/// The first two dimensions of Sobol's sequence and Owen scrambling by hashes.
///
/// Every aligned block of 2^m points is a (0, m, 2)-net in base 2: each of the 2^m boxes of any one shape
/// 2^-i x 2^(i - m) holds one point. Further dimensions are padded: pairs with scrambles and orders of their
/// own (B. Burley 2020, Practical Hash-based Owen Scrambling, JCGT 9(4)).

#include <cstdint>

#include <nusselt/core/config.h>

NUSSELT_NAMESPACE_BEGIN

NUSSELT_HD constexpr std::uint32_t reverse_bits(std::uint32_t x) noexcept {
    x = (x >> 16) | (x << 16);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/// The bits of a point in units of 2^-32.
struct UInt2 {
    std::uint32_t x, y;
};

namespace detail {

/// The second coordinate of point number index with its bits reversed.
///
/// Bit r is the parity of the sum of binomial(b, r) over the set bits b of the index. By Lucas' theorem these
/// binomials are products over the binary digits of b and r, so that five steps, one per digit, replace a
/// loop over 32 direction numbers.
NUSSELT_HD constexpr std::uint32_t sobol_y_reversed(std::uint32_t index) noexcept {
    index ^= (index >> 16) & 0x0000ffffu;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 2) & 0x33333333u;
    return index ^ ((index >> 1) & 0x55555555u);
}

/// A random permutation that may flip a bit depending on the lower bits, never on higher ones.
///
/// After S. Laine, T. Karras 2011, Stratified Sampling for Stochastic Transparency; structure and
/// constants are those of N. Vegdahl 2021, "Building a Better LK Hash" (section "The final hash").
/// \param seed should itself be random in all bits.
NUSSELT_HD constexpr std::uint32_t permute_upwards(std::uint32_t x, std::uint32_t seed) noexcept {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

/// sobol(index).x after owen_scramble(), whose reversals of bits cancel those of the sequence.
NUSSELT_HD constexpr std::uint32_t scrambled_sobol_x(std::uint32_t index, std::uint32_t seed) noexcept {
    return reverse_bits(permute_upwards(index, seed));
}
/// sobol(index).y after owen_scramble().
NUSSELT_HD constexpr std::uint32_t scrambled_sobol_y(std::uint32_t index, std::uint32_t seed) noexcept {
    return reverse_bits(permute_upwards(sobol_y_reversed(index), seed));
}

} // namespace detail

/// Point number index, not scrambled.
NUSSELT_HD constexpr UInt2 sobol(std::uint32_t index) noexcept {
    return {reverse_bits(index), reverse_bits(detail::sobol_y_reversed(index))};
}

/// Owen scrambling: swaps the halves of [0, 1) at random, the quarters in each half, and so on.
/// \param x    in units of 2^-32.
/// \param seed should itself be random in all bits, such as the result of pcg4d().
NUSSELT_HD constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) noexcept {
    return reverse_bits(detail::permute_upwards(reverse_bits(x), seed));
}

/// Seeds of one pair of dimensions; random in all bits.
struct SobolSeeds {
    std::uint32_t order, x, y;
};

/// Point number index of a sequence with scrambled coordinates and order. The order keeps aligned blocks of
/// 2^m points together, so they remain (0, m, 2)-nets, while pairs of dimensions with different seeds know
/// nothing of each other.
NUSSELT_HD constexpr UInt2 owen_scrambled_sobol(std::uint32_t index, const SobolSeeds& seeds) noexcept {
    const std::uint32_t shuffled = owen_scramble(index, seeds.order);
    return {detail::scrambled_sobol_x(shuffled, seeds.x), detail::scrambled_sobol_y(shuffled, seeds.y)};
}

NUSSELT_NAMESPACE_END
