#pragma once
/// Packs in 256-bit registers. A mask is a vector whose lanes are all ones or all zeros.

#include <nusselt/simd/pack_generic.h>

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>

NUSSELT_NAMESPACE_BEGIN
namespace detail {

template <>
struct PackOps<float, 8> {
    using Vector = __m256;
    using MaskVector = __m256;

    static Vector broadcast(float x) noexcept { return _mm256_set1_ps(x); }
    static Vector load(const float* source) noexcept { return _mm256_loadu_ps(source); }
    static void store(float* target, Vector a) noexcept { _mm256_storeu_ps(target, a); }
    static Vector gather(const float* base, const std::int32_t* indices, MaskVector active) noexcept {
        const __m256i offsets = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(indices));
        return _mm256_mask_i32gather_ps(_mm256_setzero_ps(), base, offsets, active, 4);
    }

    static Vector add(Vector a, Vector b) noexcept { return _mm256_add_ps(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return _mm256_sub_ps(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return _mm256_mul_ps(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return _mm256_div_ps(a, b); }
    static Vector negate(Vector a) noexcept { return -a; }
    static Vector fma(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
    static Vector sqrt(Vector a) noexcept { return _mm256_sqrt_ps(a); }
    static Vector floor(Vector a) noexcept { return _mm256_floor_ps(a); }
    static Vector max(Vector a, Vector b) noexcept { return _mm256_max_ps(a, b); }
    static Vector min(Vector a, Vector b) noexcept { return _mm256_min_ps(a, b); }

    static Vector bit_and(Vector a, Vector b) noexcept { return _mm256_and_ps(a, b); }
    static Vector bit_or(Vector a, Vector b) noexcept { return _mm256_or_ps(a, b); }
    static Vector bit_clear(Vector a, Vector b) noexcept { return _mm256_andnot_ps(b, a); }
    static Vector subtract_bits(Vector a, Vector b) noexcept {
        return _mm256_castsi256_ps(_mm256_sub_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
    }

    static MaskVector less(Vector a, Vector b) noexcept { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
    static MaskVector equal(Vector a, Vector b) noexcept { return _mm256_cmp_ps(a, b, _CMP_EQ_OQ); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return _mm256_cmp_ps(a, b, _CMP_NEQ_UQ); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept {
        return _mm256_blendv_ps(b, a, mask);
    }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return _mm256_and_ps(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return _mm256_or_ps(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return _mm256_xor_ps(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept {
        return _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(-1)));
    }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        const __m256i own_bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        const __m256i all_bits = _mm256_set1_epi32(static_cast<std::int32_t>(bits));
        return _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(all_bits, own_bit), own_bit));
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept {
        return static_cast<std::uint32_t>(_mm256_movemask_ps(a));
    }
};

template <>
struct PackOps<double, 4> {
    using Vector = __m256d;
    using MaskVector = __m256d;

    static Vector broadcast(double x) noexcept { return _mm256_set1_pd(x); }
    static Vector load(const double* source) noexcept { return _mm256_loadu_pd(source); }
    static void store(double* target, Vector a) noexcept { _mm256_storeu_pd(target, a); }
    static Vector gather(const double* base, const std::int32_t* indices, MaskVector active) noexcept {
        const __m128i offsets = _mm_loadu_si128(reinterpret_cast<const __m128i*>(indices));
        return _mm256_mask_i32gather_pd(_mm256_setzero_pd(), base, offsets, active, 8);
    }

    static Vector add(Vector a, Vector b) noexcept { return _mm256_add_pd(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return _mm256_sub_pd(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return _mm256_mul_pd(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return _mm256_div_pd(a, b); }
    static Vector negate(Vector a) noexcept { return -a; }
    static Vector fma(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_pd(a, b, c); }
    static Vector sqrt(Vector a) noexcept { return _mm256_sqrt_pd(a); }
    static Vector floor(Vector a) noexcept { return _mm256_floor_pd(a); }
    static Vector max(Vector a, Vector b) noexcept { return _mm256_max_pd(a, b); }
    static Vector min(Vector a, Vector b) noexcept { return _mm256_min_pd(a, b); }

    static Vector bit_and(Vector a, Vector b) noexcept { return _mm256_and_pd(a, b); }
    static Vector bit_or(Vector a, Vector b) noexcept { return _mm256_or_pd(a, b); }
    static Vector bit_clear(Vector a, Vector b) noexcept { return _mm256_andnot_pd(b, a); }
    static Vector subtract_bits(Vector a, Vector b) noexcept {
        return _mm256_castsi256_pd(_mm256_sub_epi64(_mm256_castpd_si256(a), _mm256_castpd_si256(b)));
    }

    static MaskVector less(Vector a, Vector b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LE_OQ); }
    static MaskVector equal(Vector a, Vector b) noexcept { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return _mm256_cmp_pd(a, b, _CMP_NEQ_UQ); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept {
        return _mm256_blendv_pd(b, a, mask);
    }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return _mm256_and_pd(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return _mm256_or_pd(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return _mm256_xor_pd(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept {
        return _mm256_xor_pd(a, _mm256_castsi256_pd(_mm256_set1_epi32(-1)));
    }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        const __m256i own_bit = _mm256_set_epi64x(8, 4, 2, 1);
        const __m256i all_bits = _mm256_set1_epi64x(bits);
        return _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(all_bits, own_bit), own_bit));
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept {
        return static_cast<std::uint32_t>(_mm256_movemask_pd(a));
    }
};

} // namespace detail
NUSSELT_NAMESPACE_END
#endif
