#pragma once
/// Pseudorandom bits: a hash without state for kernels, and a generator with state for everything sequential.

#include <cstdint>

#include <nusselt/core/config.h>

NUSSELT_NAMESPACE_BEGIN

/// Four words of random bits, or a key to hash.
struct UInt4 {
    std::uint32_t x, y, z, w;
};

/// Hash of four words, the pcg4d of M. Jarzynski, M. Olano 2020, Hash Functions for GPU Rendering, JCGT 9(3).
/// A bijection. The high bits of the result are the better ones, the highest bit of a key is the worst.
NUSSELT_HD constexpr UInt4 pcg4d(UInt4 v) noexcept {
    constexpr std::uint32_t kFactor = 1664525u;
    constexpr std::uint32_t kIncrement = 1013904223u;
    v = {v.x * kFactor + kIncrement, v.y * kFactor + kIncrement, v.z * kFactor + kIncrement,
         v.w * kFactor + kIncrement};
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = {v.x ^ (v.x >> 16), v.y ^ (v.y >> 16), v.z ^ (v.z >> 16), v.w ^ (v.w >> 16)};
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

/// PCG32 (XSH RR 64/32) of M. O'Neill 2014, PCG: A Family of Simple Fast Space-Efficient Statistically Good
/// Algorithms for Random Number Generation, HMC-CS-2014-0905, Sec. 6.3. Period 2^64. A
/// UniformRandomBitGenerator.
class Pcg32 {
public:
    using result_type = std::uint32_t;

    /// \param seed   where in the sequence to start.
    /// \param stream one of 2^63 sequences; the highest bit is ignored.
    NUSSELT_HD explicit constexpr Pcg32(std::uint64_t seed, std::uint64_t stream = 0) noexcept
        : increment_((stream << 1) | 1u) {
        advance();
        state_ += seed;
        advance();
    }

    NUSSELT_HD constexpr std::uint32_t operator()() noexcept {
        const std::uint64_t old = state_;
        advance();
        const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
        const auto rotation = static_cast<std::uint32_t>(old >> 59);
        return (shifted >> rotation) | (shifted << ((32u - rotation) & 31u));
    }

    NUSSELT_HD static constexpr std::uint32_t min() noexcept { return 0; }
    NUSSELT_HD static constexpr std::uint32_t max() noexcept { return 0xffffffffu; }

private:
    NUSSELT_HD constexpr void advance() noexcept {
        constexpr std::uint64_t kFactor = 6364136223846793005u;
        state_ = state_ * kFactor + increment_;
    }

    std::uint64_t state_ = 0;
    std::uint64_t increment_;
};

NUSSELT_NAMESPACE_END
