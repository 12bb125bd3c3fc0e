#pragma once
/// Conversion of random bits to numbers in [0, 1).

#include <cstdint>

#include <nusselt/core/real.h>

NUSSELT_NAMESPACE_BEGIN

/// A number in [0, 1), never 1: the highest 24 bits as float, all 32 as double or long double. Exact.
template <class Scalar = float>
NUSSELT_HD constexpr Scalar to_unit(std::uint32_t bits) noexcept {
    if constexpr (std::is_same_v<Scalar, float>) {
        // SSE and AVX2 convert signed integers only, and 24 bits fit.
        return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24f;
    } else {
        return static_cast<Scalar>(bits) * Scalar(0x1p-32L);
    }
}

/// (u + k) / n, brought back into [k / n, (k + 1) / n) where rounding leaves it: point k of n that share u.
/// \param u in [0, 1).
/// \param k below n.
/// \param n at least 1, at most 2^23 for float.
template <class Scalar>
NUSSELT_HD constexpr Scalar uniform_jittered(Scalar u, std::uint32_t k, std::uint32_t n) noexcept {
    const auto begin = static_cast<Scalar>(static_cast<std::int32_t>(k));
    const auto count = static_cast<Scalar>(static_cast<std::int32_t>(n));
    // The product rounds to the number before the end of the stratum.
    constexpr Scalar kBelowOne = 1 - std::numeric_limits<Scalar>::epsilon() / 2;
    const Scalar largest = (begin + 1) / count * kBelowOne;
    const Scalar jittered = (u + begin) / count;
    return jittered < largest ? jittered : largest;
}

NUSSELT_NAMESPACE_END
