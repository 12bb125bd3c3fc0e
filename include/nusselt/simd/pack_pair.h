#pragma once
/// Packs of twice, four times and so on as many lanes as a register has: two packs of half the size. Both halves
/// run through the same code at once, which hides the latency of long chains of operations.

#include <nusselt/simd/pack_generic.h>

NUSSELT_NAMESPACE_BEGIN

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
inline constexpr int kNativeBytes = 64;
#elif defined(__AVX2__) && defined(__FMA__)
inline constexpr int kNativeBytes = 32;
#else
inline constexpr int kNativeBytes = 16;
#endif

/// Lanes of T (float or double) in the widest register of this translation unit's instruction set.
template <class T>
inline constexpr int kNativeLanes = kNativeBytes / static_cast<int>(sizeof(T));

namespace detail {

template <class T, int N>
inline constexpr bool kIsPair = N > kNativeLanes<T>&& N % (2 * kNativeLanes<T>) == 0;

template <class T, int N>
struct PackOps<T, N, std::enable_if_t<kIsPair<T, N>>> {
    static_assert(N <= 32, "Mask::bits() has one bit per lane in 32 bits");
    static constexpr int kHalf = N / 2;
    using Half = PackOps<T, kHalf>;

    struct Vector {
        typename Half::Vector low, high;
    };
    struct MaskVector {
        typename Half::MaskVector low, high;
    };

    static Vector broadcast(T x) noexcept { return {Half::broadcast(x), Half::broadcast(x)}; }
    static Vector load(const T* source) noexcept { return {Half::load(source), Half::load(source + kHalf)}; }
    static void store(T* target, const Vector& a) noexcept {
        Half::store(target, a.low);
        Half::store(target + kHalf, a.high);
    }
    static Vector gather(const T* base, const std::int32_t* indices, const MaskVector& active) noexcept {
        return {Half::gather(base, indices, active.low), Half::gather(base, indices + kHalf, active.high)};
    }

    static Vector add(const Vector& a, const Vector& b) noexcept {
        return {Half::add(a.low, b.low), Half::add(a.high, b.high)};
    }
    static Vector subtract(const Vector& a, const Vector& b) noexcept {
        return {Half::subtract(a.low, b.low), Half::subtract(a.high, b.high)};
    }
    static Vector multiply(const Vector& a, const Vector& b) noexcept {
        return {Half::multiply(a.low, b.low), Half::multiply(a.high, b.high)};
    }
    static Vector divide(const Vector& a, const Vector& b) noexcept {
        return {Half::divide(a.low, b.low), Half::divide(a.high, b.high)};
    }
    static Vector negate(const Vector& a) noexcept { return {Half::negate(a.low), Half::negate(a.high)}; }
    static Vector fma(const Vector& a, const Vector& b, const Vector& c) noexcept {
        return {Half::fma(a.low, b.low, c.low), Half::fma(a.high, b.high, c.high)};
    }
    static Vector difference_of_products(const Vector& a, const Vector& b, const Vector& c,
                                         const Vector& d) noexcept {
        return {Half::difference_of_products(a.low, b.low, c.low, d.low),
                Half::difference_of_products(a.high, b.high, c.high, d.high)};
    }
    static Vector sqrt(const Vector& a) noexcept { return {Half::sqrt(a.low), Half::sqrt(a.high)}; }
    static Vector floor(const Vector& a) noexcept { return {Half::floor(a.low), Half::floor(a.high)}; }
    static Vector max(const Vector& a, const Vector& b) noexcept {
        return {Half::max(a.low, b.low), Half::max(a.high, b.high)};
    }
    static Vector min(const Vector& a, const Vector& b) noexcept {
        return {Half::min(a.low, b.low), Half::min(a.high, b.high)};
    }

    static Vector bit_and(const Vector& a, const Vector& b) noexcept {
        return {Half::bit_and(a.low, b.low), Half::bit_and(a.high, b.high)};
    }
    static Vector bit_or(const Vector& a, const Vector& b) noexcept {
        return {Half::bit_or(a.low, b.low), Half::bit_or(a.high, b.high)};
    }
    static Vector bit_clear(const Vector& a, const Vector& b) noexcept {
        return {Half::bit_clear(a.low, b.low), Half::bit_clear(a.high, b.high)};
    }
    static Vector subtract_bits(const Vector& a, const Vector& b) noexcept {
        return {Half::subtract_bits(a.low, b.low), Half::subtract_bits(a.high, b.high)};
    }

    static MaskVector less(const Vector& a, const Vector& b) noexcept {
        return {Half::less(a.low, b.low), Half::less(a.high, b.high)};
    }
    static MaskVector less_equal(const Vector& a, const Vector& b) noexcept {
        return {Half::less_equal(a.low, b.low), Half::less_equal(a.high, b.high)};
    }
    static MaskVector equal(const Vector& a, const Vector& b) noexcept {
        return {Half::equal(a.low, b.low), Half::equal(a.high, b.high)};
    }
    static MaskVector not_equal(const Vector& a, const Vector& b) noexcept {
        return {Half::not_equal(a.low, b.low), Half::not_equal(a.high, b.high)};
    }
    static Vector select(const MaskVector& mask, const Vector& a, const Vector& b) noexcept {
        return {Half::select(mask.low, a.low, b.low), Half::select(mask.high, a.high, b.high)};
    }

    static MaskVector mask_and(const MaskVector& a, const MaskVector& b) noexcept {
        return {Half::mask_and(a.low, b.low), Half::mask_and(a.high, b.high)};
    }
    static MaskVector mask_or(const MaskVector& a, const MaskVector& b) noexcept {
        return {Half::mask_or(a.low, b.low), Half::mask_or(a.high, b.high)};
    }
    static MaskVector mask_xor(const MaskVector& a, const MaskVector& b) noexcept {
        return {Half::mask_xor(a.low, b.low), Half::mask_xor(a.high, b.high)};
    }
    static MaskVector mask_not(const MaskVector& a) noexcept {
        return {Half::mask_not(a.low), Half::mask_not(a.high)};
    }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        constexpr std::uint32_t kLow = ~std::uint32_t{0} >> (32 - kHalf);
        return {Half::mask_from_bits(bits & kLow), Half::mask_from_bits(bits >> kHalf)};
    }
    static std::uint32_t mask_to_bits(const MaskVector& a) noexcept {
        return Half::mask_to_bits(a.low) | Half::mask_to_bits(a.high) << kHalf;
    }
};

} // namespace detail
NUSSELT_NAMESPACE_END
