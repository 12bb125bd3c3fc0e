#pragma once
/// Packs in 128-bit registers of WebAssembly (-msimd128). A mask is a vector whose lanes are all ones or all zeros. There
/// is no instruction for fma without the relaxed instructions, which may round either way.

#include <nusselt/simd/pack_generic.h>

#if defined(__wasm_simd128__)
#include <wasm_simd128.h>

NUSSELT_NAMESPACE_BEGIN
namespace detail {

/// What both number types share: bits of registers.
struct WasmBits {
    using Vector = v128_t;
    using MaskVector = v128_t;

    static Vector bit_and(Vector a, Vector b) noexcept { return wasm_v128_and(a, b); }
    static Vector bit_or(Vector a, Vector b) noexcept { return wasm_v128_or(a, b); }
    static Vector bit_clear(Vector a, Vector b) noexcept { return wasm_v128_andnot(a, b); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept {
        return wasm_v128_bitselect(a, b, mask);
    }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return wasm_v128_and(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return wasm_v128_or(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return wasm_v128_xor(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept { return wasm_v128_not(a); }
};

template <>
struct PackOps<float, 4> : WasmBits {
    static Vector broadcast(float x) noexcept { return wasm_f32x4_splat(x); }
    static Vector load(const float* source) noexcept { return wasm_v128_load(source); }
    static void store(float* target, Vector a) noexcept { wasm_v128_store(target, a); }
    static Vector gather(const float* base, const std::int32_t* indices, MaskVector active) noexcept {
        const std::uint32_t bits = mask_to_bits(active);
        float lanes[4];
        for (int i = 0; i < 4; ++i) lanes[i] = (bits >> i & 1u) != 0 ? base[indices[i]] : 0.0f;
        return load(lanes);
    }

    static Vector add(Vector a, Vector b) noexcept { return wasm_f32x4_add(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return wasm_f32x4_sub(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return wasm_f32x4_mul(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return wasm_f32x4_div(a, b); }
    static Vector negate(Vector a) noexcept { return wasm_f32x4_neg(a); }
    /// Through double, as the scalar fma.
    static Vector fma(Vector a, Vector b, Vector c) noexcept {
        const auto sum = [](v128_t x, v128_t y, v128_t z) { return wasm_f64x2_add(wasm_f64x2_mul(x, y), z); };
        return rounded(sum(low(a), low(b), low(c)), sum(high(a), high(b), high(c)));
    }
    static Vector difference_of_products(Vector a, Vector b, Vector c, Vector d) noexcept {
        const auto difference = [](v128_t x, v128_t y, v128_t z, v128_t w) {
            return wasm_f64x2_sub(wasm_f64x2_mul(x, y), wasm_f64x2_mul(z, w));
        };
        return rounded(difference(low(a), low(b), low(c), low(d)),
                       difference(high(a), high(b), high(c), high(d)));
    }
    static Vector sqrt(Vector a) noexcept { return wasm_f32x4_sqrt(a); }
    static Vector floor(Vector a) noexcept { return wasm_f32x4_floor(a); }
    // These instructions return their first operand if either is NaN or both are zeros.
    static Vector max(Vector a, Vector b) noexcept { return wasm_f32x4_pmax(b, a); }
    static Vector min(Vector a, Vector b) noexcept { return wasm_f32x4_pmin(b, a); }

    static Vector subtract_bits(Vector a, Vector b) noexcept { return wasm_i32x4_sub(a, b); }

    static MaskVector less(Vector a, Vector b) noexcept { return wasm_f32x4_lt(a, b); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return wasm_f32x4_le(a, b); }
    static MaskVector equal(Vector a, Vector b) noexcept { return wasm_f32x4_eq(a, b); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return wasm_f32x4_ne(a, b); }

    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        const v128_t own_bit = wasm_i32x4_make(1, 2, 4, 8);
        const v128_t all_bits = wasm_i32x4_splat(static_cast<std::int32_t>(bits));
        return wasm_i32x4_eq(wasm_v128_and(all_bits, own_bit), own_bit);
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept {
        return static_cast<std::uint32_t>(wasm_i32x4_bitmask(a));
    }

private:
    static v128_t low(Vector a) noexcept { return wasm_f64x2_promote_low_f32x4(a); }
    static v128_t high(Vector a) noexcept {
        return wasm_f64x2_promote_low_f32x4(wasm_i64x2_shuffle(a, a, 1, 1));
    }
    /// Doubles of lanes 0, 1 and 2, 3 as floats.
    static Vector rounded(v128_t low, v128_t high) noexcept {
        return wasm_i64x2_shuffle(wasm_f32x4_demote_f64x2_zero(low), wasm_f32x4_demote_f64x2_zero(high), 0,
                                  2);
    }
};

template <>
struct PackOps<double, 2> : WasmBits {
    static Vector broadcast(double x) noexcept { return wasm_f64x2_splat(x); }
    static Vector load(const double* source) noexcept { return wasm_v128_load(source); }
    static void store(double* target, Vector a) noexcept { wasm_v128_store(target, a); }
    static Vector gather(const double* base, const std::int32_t* indices, MaskVector active) noexcept {
        const std::uint32_t bits = mask_to_bits(active);
        const double low = (bits & 1u) != 0 ? base[indices[0]] : 0.0;
        const double high = (bits & 2u) != 0 ? base[indices[1]] : 0.0;
        return wasm_f64x2_make(low, high);
    }

    static Vector add(Vector a, Vector b) noexcept { return wasm_f64x2_add(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return wasm_f64x2_sub(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return wasm_f64x2_mul(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return wasm_f64x2_div(a, b); }
    static Vector negate(Vector a) noexcept { return wasm_f64x2_neg(a); }
    static Vector fma(Vector a, Vector b, Vector c) noexcept {
        return wasm_f64x2_make(nusselt::fma(wasm_f64x2_extract_lane(a, 0), wasm_f64x2_extract_lane(b, 0),
                                            wasm_f64x2_extract_lane(c, 0)),
                               nusselt::fma(wasm_f64x2_extract_lane(a, 1), wasm_f64x2_extract_lane(b, 1),
                                            wasm_f64x2_extract_lane(c, 1)));
    }
    static Vector sqrt(Vector a) noexcept { return wasm_f64x2_sqrt(a); }
    static Vector floor(Vector a) noexcept { return wasm_f64x2_floor(a); }
    // These instructions return their first operand if either is NaN or both are zeros.
    static Vector max(Vector a, Vector b) noexcept { return wasm_f64x2_pmax(b, a); }
    static Vector min(Vector a, Vector b) noexcept { return wasm_f64x2_pmin(b, a); }

    static Vector subtract_bits(Vector a, Vector b) noexcept { return wasm_i64x2_sub(a, b); }

    static MaskVector less(Vector a, Vector b) noexcept { return wasm_f64x2_lt(a, b); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return wasm_f64x2_le(a, b); }
    static MaskVector equal(Vector a, Vector b) noexcept { return wasm_f64x2_eq(a, b); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return wasm_f64x2_ne(a, b); }

    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        const auto all_ones_if = [](std::uint32_t bit) { return -static_cast<std::int64_t>(bit); };
        return wasm_i64x2_make(all_ones_if(bits & 1u), all_ones_if(bits >> 1 & 1u));
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept {
        return static_cast<std::uint32_t>(wasm_i64x2_bitmask(a));
    }
};

} // namespace detail
NUSSELT_NAMESPACE_END
#endif
