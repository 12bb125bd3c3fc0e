#ifndef NUSSELT_RANDOM_BLUE_NOISE_GLSL
#define NUSSELT_RANDOM_BLUE_NOISE_GLSL
// Follows include/nusselt/random/blue_noise.h @ 48feda4799f7
/// Blue noise for dithering, tiled over the screen. Twin of include/nusselt/random/blue_noise.h, where the sources stand.
/// Upload the bytes of data/blue-noise.bin as an array of words.

#include "../core/compatibility.glsl"

const uint kNusseltBlueNoiseSideBits = 6u; ///< squares of 64 x 64 pixels
const uint kNusseltBlueNoiseRankBits = 12u;
const uint kNusseltBlueNoisePairBits = 2u; ///< twice as many squares as pairs

uint blue_noise_index(uint square, uint shift_x, uint shift_y, uint x, uint y) {
    const uint kMask = (1u << kNusseltBlueNoiseSideBits) - 1u;
    uint column = (x + (shift_x >> (32u - kNusseltBlueNoiseSideBits))) & kMask;
    uint row = (y + (shift_y >> (32u - kNusseltBlueNoiseSideBits))) & kMask;
    return (square << kNusseltBlueNoiseRankBits) + (row << kNusseltBlueNoiseSideBits) + column;
}

/// The indices of the two ranks of a pixel. Each comes from another square of a random pair, with a random shift.
/// \param key random in all bits.
uvec2 blue_noise_indices(uvec4 key, uint x, uint y) {
    uint pair = (key.x >> (32u - kNusseltBlueNoiseSideBits - kNusseltBlueNoisePairBits)) &
                ((1u << kNusseltBlueNoisePairBits) - 1u);
    return uvec2(blue_noise_index(2u * pair, key.x, key.y, x, y), blue_noise_index(2u * pair + 1u, key.z, key.w, x, y));
}

/// The rank with an index. \param word number index / 2 of the file
uint blue_noise_rank(uint word, uint index) { return (word >> (16u * (index & 1u))) & 0xffffu; }

/// A number whose high bits are a rank, in units of 2^-32. \param low random in its high bits, for what is below a rank.
uint blue_noise_bits(uint rank, uint low) {
    return (rank << (32u - kNusseltBlueNoiseRankBits)) | (low >> kNusseltBlueNoiseRankBits);
}

#endif
