#pragma once
/// Packs in 128-bit registers, for all x86-64 processors: SSE2 is always there. A mask is a vector whose lanes are all
/// ones or all zeros.

#include <nusselt/simd/pack_generic.h>

#if defined(__SSE2__)
#include <immintrin.h>

NUSSELT_NAMESPACE_BEGIN
namespace detail {

template <>
struct PackOps<float, 4> {
    using Vector = __m128;
    using MaskVector = __m128;

    static Vector broadcast(float x) noexcept { return _mm_set1_ps(x); }
    static Vector load(const float* source) noexcept { return _mm_loadu_ps(source); }
    static void store(float* target, Vector a) noexcept { _mm_storeu_ps(target, a); }
    static Vector gather(const float* base, const std::int32_t* indices, MaskVector active) noexcept {
        const std::uint32_t bits = mask_to_bits(active);
        float lanes[4];
        for (int i = 0; i < 4; ++i) lanes[i] = (bits >> i & 1u) != 0 ? base[indices[i]] : 0.0f;
        return load(lanes);
    }

    static Vector add(Vector a, Vector b) noexcept { return _mm_add_ps(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return _mm_sub_ps(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return _mm_mul_ps(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return _mm_div_ps(a, b); }
    static Vector negate(Vector a) noexcept { return -a; }
    static Vector fma(Vector a, Vector b, Vector c) noexcept {
#if defined(__FMA__)
        return _mm_fmadd_ps(a, b, c);
#else
        // Through double, as the scalar fma.
        const auto low = [](__m128 x) { return _mm_cvtps_pd(x); };
        const auto high = [](__m128 x) { return _mm_cvtps_pd(_mm_movehl_ps(x, x)); };
        const __m128d sum_low = _mm_add_pd(_mm_mul_pd(low(a), low(b)), low(c));
        const __m128d sum_high = _mm_add_pd(_mm_mul_pd(high(a), high(b)), high(c));
        return _mm_movelh_ps(_mm_cvtpd_ps(sum_low), _mm_cvtpd_ps(sum_high));
#endif
    }
    /// See Pack: without an instruction for fma only.
    static Vector difference_of_products(Vector a, Vector b, Vector c, Vector d) noexcept {
        const auto low = [](__m128 x) { return _mm_cvtps_pd(x); };
        const auto high = [](__m128 x) { return _mm_cvtps_pd(_mm_movehl_ps(x, x)); };
        const __m128d first = _mm_sub_pd(_mm_mul_pd(low(a), low(b)), _mm_mul_pd(low(c), low(d)));
        const __m128d second = _mm_sub_pd(_mm_mul_pd(high(a), high(b)), _mm_mul_pd(high(c), high(d)));
        return _mm_movelh_ps(_mm_cvtpd_ps(first), _mm_cvtpd_ps(second));
    }
    static Vector sqrt(Vector a) noexcept { return _mm_sqrt_ps(a); }
    static Vector floor(Vector a) noexcept {
#if defined(__SSE4_2__)
        return _mm_floor_ps(a);
#else
        // Numbers from 2^23 on are integers already, and so is what is no number.
        const __m128 sign_bit = _mm_set1_ps(-0.0f);
        const __m128 fits = less(bit_clear(a, sign_bit), _mm_set1_ps(8388608.0f));
        const __m128 truncated = _mm_cvtepi32_ps(_mm_cvttps_epi32(a));
        const __m128 below = _mm_sub_ps(truncated, _mm_and_ps(less(a, truncated), _mm_set1_ps(1.0f)));
        return select(fits, _mm_or_ps(below, _mm_and_ps(a, sign_bit)), a);
#endif
    }
    static Vector max(Vector a, Vector b) noexcept { return _mm_max_ps(a, b); }
    static Vector min(Vector a, Vector b) noexcept { return _mm_min_ps(a, b); }

    static Vector bit_and(Vector a, Vector b) noexcept { return _mm_and_ps(a, b); }
    static Vector bit_or(Vector a, Vector b) noexcept { return _mm_or_ps(a, b); }
    static Vector bit_clear(Vector a, Vector b) noexcept { return _mm_andnot_ps(b, a); }
    static Vector subtract_bits(Vector a, Vector b) noexcept {
        return _mm_castsi128_ps(_mm_sub_epi32(_mm_castps_si128(a), _mm_castps_si128(b)));
    }

    static MaskVector less(Vector a, Vector b) noexcept { return _mm_cmplt_ps(a, b); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return _mm_cmple_ps(a, b); }
    static MaskVector equal(Vector a, Vector b) noexcept { return _mm_cmpeq_ps(a, b); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return _mm_cmpneq_ps(a, b); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept {
#if defined(__SSE4_2__)
        return _mm_blendv_ps(b, a, mask);
#else
        return _mm_or_ps(_mm_and_ps(mask, a), _mm_andnot_ps(mask, b));
#endif
    }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return _mm_and_ps(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return _mm_or_ps(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return _mm_xor_ps(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept {
        return _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi32(-1)));
    }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        const __m128i own_bit = _mm_setr_epi32(1, 2, 4, 8);
        const __m128i all_bits = _mm_set1_epi32(static_cast<std::int32_t>(bits));
        return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(all_bits, own_bit), own_bit));
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept {
        return static_cast<std::uint32_t>(_mm_movemask_ps(a));
    }
};

template <>
struct PackOps<double, 2> {
    using Vector = __m128d;
    using MaskVector = __m128d;

    static Vector broadcast(double x) noexcept { return _mm_set1_pd(x); }
    static Vector load(const double* source) noexcept { return _mm_loadu_pd(source); }
    static void store(double* target, Vector a) noexcept { _mm_storeu_pd(target, a); }
    static Vector gather(const double* base, const std::int32_t* indices, MaskVector active) noexcept {
        const std::uint32_t bits = mask_to_bits(active);
        const double low = (bits & 1u) != 0 ? base[indices[0]] : 0.0;
        const double high = (bits & 2u) != 0 ? base[indices[1]] : 0.0;
        return _mm_setr_pd(low, high);
    }

    static Vector add(Vector a, Vector b) noexcept { return _mm_add_pd(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return _mm_sub_pd(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return _mm_mul_pd(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return _mm_div_pd(a, b); }
    static Vector negate(Vector a) noexcept { return -a; }
    static Vector fma(Vector a, Vector b, Vector c) noexcept {
#if defined(__FMA__)
        return _mm_fmadd_pd(a, b, c);
#else
        const auto high = [](__m128d x) { return _mm_cvtsd_f64(_mm_unpackhi_pd(x, x)); };
        return _mm_setr_pd(nusselt::fma(_mm_cvtsd_f64(a), _mm_cvtsd_f64(b), _mm_cvtsd_f64(c)),
                           nusselt::fma(high(a), high(b), high(c)));
#endif
    }
    static Vector sqrt(Vector a) noexcept { return _mm_sqrt_pd(a); }
    static Vector floor(Vector a) noexcept {
#if defined(__SSE4_2__)
        return _mm_floor_pd(a);
#else
        return _mm_setr_pd(nusselt::floor(_mm_cvtsd_f64(a)),
                           nusselt::floor(_mm_cvtsd_f64(_mm_unpackhi_pd(a, a))));
#endif
    }
    static Vector max(Vector a, Vector b) noexcept { return _mm_max_pd(a, b); }
    static Vector min(Vector a, Vector b) noexcept { return _mm_min_pd(a, b); }

    static Vector bit_and(Vector a, Vector b) noexcept { return _mm_and_pd(a, b); }
    static Vector bit_or(Vector a, Vector b) noexcept { return _mm_or_pd(a, b); }
    static Vector bit_clear(Vector a, Vector b) noexcept { return _mm_andnot_pd(b, a); }
    static Vector subtract_bits(Vector a, Vector b) noexcept {
        return _mm_castsi128_pd(_mm_sub_epi64(_mm_castpd_si128(a), _mm_castpd_si128(b)));
    }

    static MaskVector less(Vector a, Vector b) noexcept { return _mm_cmplt_pd(a, b); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return _mm_cmple_pd(a, b); }
    static MaskVector equal(Vector a, Vector b) noexcept { return _mm_cmpeq_pd(a, b); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return _mm_cmpneq_pd(a, b); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept {
#if defined(__SSE4_2__)
        return _mm_blendv_pd(b, a, mask);
#else
        return _mm_or_pd(_mm_and_pd(mask, a), _mm_andnot_pd(mask, b));
#endif
    }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return _mm_and_pd(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return _mm_or_pd(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return _mm_xor_pd(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept {
        return _mm_xor_pd(a, _mm_castsi128_pd(_mm_set1_epi32(-1)));
    }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        const auto all_ones_if = [](std::uint32_t bit) { return -static_cast<std::int64_t>(bit); };
        return _mm_castsi128_pd(_mm_set_epi64x(all_ones_if(bits >> 1 & 1u), all_ones_if(bits & 1u)));
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept {
        return static_cast<std::uint32_t>(_mm_movemask_pd(a));
    }
};

} // namespace detail
NUSSELT_NAMESPACE_END
#endif
