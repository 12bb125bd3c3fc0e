#pragma once
/// The bases of Pack and Mask, over arrays. The specialisations in pack_sse.h, pack_avx2.h,
/// pack_avx512.h, pack_neon.h and pack_wasm.h have the same members over registers.

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <nusselt/core/real.h>

NUSSELT_NAMESPACE_BEGIN
namespace detail {

/// The third parameter is for specialisations by condition.
template <class T, int N, class = void>
struct PackOps {
    static_assert(std::is_same_v<T, float> || std::is_same_v<T, double>,
                  "packs have lanes of float or double");
    static_assert(0 < N && N <= 32, "Mask::bits() has one bit per lane in 32 bits");

    struct Vector {
        T lanes[N];
    };
    using MaskVector = std::uint32_t;

    static Vector broadcast(T x) noexcept {
        Vector result;
        for (int i = 0; i < N; ++i) result.lanes[i] = x;
        return result;
    }
    static Vector load(const T* source) noexcept {
        Vector result;
        std::memcpy(result.lanes, source, sizeof result.lanes);
        return result;
    }
    static void store(T* target, const Vector& a) noexcept { std::memcpy(target, a.lanes, sizeof a.lanes); }
    static Vector gather(const T* base, const std::int32_t* indices, MaskVector active) noexcept {
        Vector result;
        for (int i = 0; i < N; ++i) result.lanes[i] = (active >> i & 1u) != 0 ? base[indices[i]] : T(0);
        return result;
    }

    static Vector add(const Vector& a, const Vector& b) noexcept {
        return map([](T x, T y) { return x + y; }, a, b);
    }
    static Vector subtract(const Vector& a, const Vector& b) noexcept {
        return map([](T x, T y) { return x - y; }, a, b);
    }
    static Vector multiply(const Vector& a, const Vector& b) noexcept {
        return map([](T x, T y) { return x * y; }, a, b);
    }
    static Vector divide(const Vector& a, const Vector& b) noexcept {
        return map([](T x, T y) { return x / y; }, a, b);
    }
    /// The specialisations negate by an operator, which GCC merges into fma, unlike a flip of the sign
    /// bits.
    static Vector negate(const Vector& a) noexcept {
        return map([](T x) { return -x; }, a);
    }
    static Vector fma(const Vector& a, const Vector& b, const Vector& c) noexcept {
        return map([](T x, T y, T z) { return nusselt::fma(x, y, z); }, a, b, c);
    }
    static Vector difference_of_products(const Vector& a, const Vector& b, const Vector& c,
                                         const Vector& d) noexcept {
        return map([](T x, T y, T z, T w) { return nusselt::difference_of_products(x, y, z, w); }, a, b, c,
                   d);
    }
    static Vector sqrt(const Vector& a) noexcept {
        return map([](T x) { return nusselt::sqrt(x); }, a);
    }
    static Vector floor(const Vector& a) noexcept {
        return map([](T x) { return nusselt::floor(x); }, a);
    }
    static Vector max(const Vector& a, const Vector& b) noexcept {
        return map([](T x, T y) { return nusselt::max(x, y); }, a, b);
    }
    static Vector min(const Vector& a, const Vector& b) noexcept {
        return map([](T x, T y) { return nusselt::min(x, y); }, a, b);
    }

    static Vector bit_and(const Vector& a, const Vector& b) noexcept {
        return map_bits([](Bits x, Bits y) { return x & y; }, a, b);
    }
    static Vector bit_or(const Vector& a, const Vector& b) noexcept {
        return map_bits([](Bits x, Bits y) { return x | y; }, a, b);
    }
    /// a without the bits of b.
    static Vector bit_clear(const Vector& a, const Vector& b) noexcept {
        return map_bits([](Bits x, Bits y) { return x & ~y; }, a, b);
    }
    /// a - b of the representations as integers.
    static Vector subtract_bits(const Vector& a, const Vector& b) noexcept {
        return map_bits([](Bits x, Bits y) { return x - y; }, a, b);
    }

    static MaskVector less(const Vector& a, const Vector& b) noexcept {
        return compare([](T x, T y) { return x < y; }, a, b);
    }
    static MaskVector less_equal(const Vector& a, const Vector& b) noexcept {
        return compare([](T x, T y) { return x <= y; }, a, b);
    }
    static MaskVector equal(const Vector& a, const Vector& b) noexcept {
        return compare([](T x, T y) { return x == y; }, a, b);
    }
    static MaskVector not_equal(const Vector& a, const Vector& b) noexcept {
        return compare([](T x, T y) { return x != y; }, a, b);
    }
    static Vector select(MaskVector mask, const Vector& a, const Vector& b) noexcept {
        Vector result;
        for (int i = 0; i < N; ++i) result.lanes[i] = (mask >> i & 1u) != 0 ? a.lanes[i] : b.lanes[i];
        return result;
    }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return a & b; }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return a | b; }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return a ^ b; }
    static MaskVector mask_not(MaskVector a) noexcept { return mask_from_bits(~a); }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        return bits & ~std::uint32_t{0} >> (32 - N);
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept { return a; }

private:
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

    template <class Function, class... Vectors>
    static Vector map(Function function, const Vectors&... operands) noexcept {
        Vector result;
        for (int i = 0; i < N; ++i) result.lanes[i] = function(operands.lanes[i]...);
        return result;
    }
    /// Lane by lane: from copies of whole arrays g++ 12 at -O3 and strict aliasing makes code that reads lanes before
    /// they are written.
    template <class Function>
    static Vector map_bits(Function function, const Vector& a, const Vector& b) noexcept {
        Vector result;
        for (int i = 0; i < N; ++i) {
            Bits x;
            Bits y;
            std::memcpy(&x, &a.lanes[i], sizeof x);
            std::memcpy(&y, &b.lanes[i], sizeof y);
            x = function(x, y);
            std::memcpy(&result.lanes[i], &x, sizeof x);
        }
        return result;
    }
    template <class Function>
    static MaskVector compare(Function function, const Vector& a, const Vector& b) noexcept {
        MaskVector result = 0;
        for (int i = 0; i < N; ++i) {
            result |= std::uint32_t{static_cast<bool>(function(a.lanes[i], b.lanes[i]))} << i;
        }
        return result;
    }
};

} // namespace detail
NUSSELT_NAMESPACE_END
