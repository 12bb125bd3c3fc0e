#pragma once
/// Packs in 512-bit registers. A mask is a mask register.
///
/// sqrt, floor, max and min are the zeroing forms with a full mask, which compile to the plain instructions:
/// the plain intrinsics of GCC 12 pass an undefined vector and warn of it (GCC bug 105593).

#include <nusselt/simd/pack_generic.h>

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include <immintrin.h>

NUSSELT_NAMESPACE_BEGIN
namespace detail {

template <>
struct PackOps<float, 16> {
    using Vector = __m512;
    using MaskVector = __mmask16;
    static constexpr MaskVector kAll = 0xffff;

    static Vector broadcast(float x) noexcept { return _mm512_set1_ps(x); }
    static Vector load(const float* source) noexcept { return _mm512_loadu_ps(source); }
    static void store(float* target, Vector a) noexcept { _mm512_storeu_ps(target, a); }
    static Vector gather(const float* base, const std::int32_t* indices, MaskVector active) noexcept {
        const __m512i offsets = _mm512_loadu_si512(indices);
        return _mm512_mask_i32gather_ps(_mm512_setzero_ps(), active, offsets, base, 4);
    }

    static Vector add(Vector a, Vector b) noexcept { return _mm512_add_ps(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return _mm512_sub_ps(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return _mm512_mul_ps(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return _mm512_div_ps(a, b); }
    static Vector negate(Vector a) noexcept { return -a; }
    static Vector fma(Vector a, Vector b, Vector c) noexcept { return _mm512_fmadd_ps(a, b, c); }
    static Vector sqrt(Vector a) noexcept { return _mm512_maskz_sqrt_ps(kAll, a); }
    static Vector floor(Vector a) noexcept {
        return _mm512_maskz_roundscale_ps(kAll, a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    }
    static Vector max(Vector a, Vector b) noexcept { return _mm512_maskz_max_ps(kAll, a, b); }
    static Vector min(Vector a, Vector b) noexcept { return _mm512_maskz_min_ps(kAll, a, b); }

    static Vector bit_and(Vector a, Vector b) noexcept { return _mm512_and_ps(a, b); }
    static Vector bit_or(Vector a, Vector b) noexcept { return _mm512_or_ps(a, b); }
    static Vector bit_clear(Vector a, Vector b) noexcept { return _mm512_andnot_ps(b, a); }
    static Vector subtract_bits(Vector a, Vector b) noexcept {
        return _mm512_castsi512_ps(_mm512_sub_epi32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
    }

    static MaskVector less(Vector a, Vector b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
    static MaskVector equal(Vector a, Vector b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_NEQ_UQ); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept {
        return _mm512_mask_blend_ps(mask, b, a);
    }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return _kand_mask16(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return _kor_mask16(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return _kxor_mask16(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept { return _knot_mask16(a); }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept { return static_cast<MaskVector>(bits); }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept { return a; }
};

template <>
struct PackOps<double, 8> {
    using Vector = __m512d;
    using MaskVector = __mmask8;
    static constexpr MaskVector kAll = 0xff;

    static Vector broadcast(double x) noexcept { return _mm512_set1_pd(x); }
    static Vector load(const double* source) noexcept { return _mm512_loadu_pd(source); }
    static void store(double* target, Vector a) noexcept { _mm512_storeu_pd(target, a); }
    static Vector gather(const double* base, const std::int32_t* indices, MaskVector active) noexcept {
        const __m256i offsets = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(indices));
        return _mm512_mask_i32gather_pd(_mm512_setzero_pd(), active, offsets, base, 8);
    }

    static Vector add(Vector a, Vector b) noexcept { return _mm512_add_pd(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return _mm512_sub_pd(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return _mm512_mul_pd(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return _mm512_div_pd(a, b); }
    static Vector negate(Vector a) noexcept { return -a; }
    static Vector fma(Vector a, Vector b, Vector c) noexcept { return _mm512_fmadd_pd(a, b, c); }
    static Vector sqrt(Vector a) noexcept { return _mm512_maskz_sqrt_pd(kAll, a); }
    static Vector floor(Vector a) noexcept {
        return _mm512_maskz_roundscale_pd(kAll, a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    }
    static Vector max(Vector a, Vector b) noexcept { return _mm512_maskz_max_pd(kAll, a, b); }
    static Vector min(Vector a, Vector b) noexcept { return _mm512_maskz_min_pd(kAll, a, b); }

    static Vector bit_and(Vector a, Vector b) noexcept { return _mm512_and_pd(a, b); }
    static Vector bit_or(Vector a, Vector b) noexcept { return _mm512_or_pd(a, b); }
    static Vector bit_clear(Vector a, Vector b) noexcept { return _mm512_andnot_pd(b, a); }
    static Vector subtract_bits(Vector a, Vector b) noexcept {
        return _mm512_castsi512_pd(_mm512_sub_epi64(_mm512_castpd_si512(a), _mm512_castpd_si512(b)));
    }

    static MaskVector less(Vector a, Vector b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
    static MaskVector equal(Vector a, Vector b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_NEQ_UQ); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept {
        return _mm512_mask_blend_pd(mask, b, a);
    }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return _kand_mask8(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return _kor_mask8(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return _kxor_mask8(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept { return _knot_mask8(a); }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept { return static_cast<MaskVector>(bits); }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept { return a; }
};

} // namespace detail
NUSSELT_NAMESPACE_END
#endif
