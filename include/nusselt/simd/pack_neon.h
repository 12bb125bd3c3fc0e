#pragma once
/// Packs in 128-bit registers of 64-bit ARM. A mask is a vector of integers whose lanes are all ones or all zeros.

#include <nusselt/simd/pack_generic.h>

#if defined(__aarch64__) && defined(__ARM_NEON)
#include <arm_neon.h>

NUSSELT_NAMESPACE_BEGIN
namespace detail {

template <>
struct PackOps<float, 4> {
    using Vector = float32x4_t;
    using MaskVector = uint32x4_t;

    static Vector broadcast(float x) noexcept { return vdupq_n_f32(x); }
    static Vector load(const float* source) noexcept { return vld1q_f32(source); }
    static void store(float* target, Vector a) noexcept { vst1q_f32(target, a); }
    static Vector gather(const float* base, const std::int32_t* indices, MaskVector active) noexcept {
        const std::uint32_t bits = mask_to_bits(active);
        float lanes[4];
        for (int i = 0; i < 4; ++i) lanes[i] = (bits >> i & 1u) != 0 ? base[indices[i]] : 0.0f;
        return load(lanes);
    }

    static Vector add(Vector a, Vector b) noexcept { return vaddq_f32(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return vsubq_f32(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return vmulq_f32(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return vdivq_f32(a, b); }
    static Vector negate(Vector a) noexcept { return vnegq_f32(a); }
    static Vector fma(Vector a, Vector b, Vector c) noexcept { return vfmaq_f32(c, a, b); }
    static Vector sqrt(Vector a) noexcept { return vsqrtq_f32(a); }
    static Vector floor(Vector a) noexcept { return vrndmq_f32(a); }
    // The instructions for extrema return NaN where either operand is NaN.
    static Vector max(Vector a, Vector b) noexcept { return select(less(b, a), a, b); }
    static Vector min(Vector a, Vector b) noexcept { return select(less(a, b), a, b); }

    static Vector bit_and(Vector a, Vector b) noexcept {
        return from_bits(vandq_u32(to_bits(a), to_bits(b)));
    }
    static Vector bit_or(Vector a, Vector b) noexcept { return from_bits(vorrq_u32(to_bits(a), to_bits(b))); }
    static Vector bit_clear(Vector a, Vector b) noexcept {
        return from_bits(vbicq_u32(to_bits(a), to_bits(b)));
    }
    static Vector subtract_bits(Vector a, Vector b) noexcept {
        return from_bits(vsubq_u32(to_bits(a), to_bits(b)));
    }

    static MaskVector less(Vector a, Vector b) noexcept { return vcltq_f32(a, b); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return vcleq_f32(a, b); }
    static MaskVector equal(Vector a, Vector b) noexcept { return vceqq_f32(a, b); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return mask_not(vceqq_f32(a, b)); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept { return vbslq_f32(mask, a, b); }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return vandq_u32(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return vorrq_u32(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return veorq_u32(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept { return vmvnq_u32(a); }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        return vtstq_u32(vdupq_n_u32(bits), bit_of_lane());
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept {
        return vaddvq_u32(vandq_u32(a, bit_of_lane()));
    }

private:
    static uint32x4_t to_bits(Vector a) noexcept { return vreinterpretq_u32_f32(a); }
    static Vector from_bits(uint32x4_t a) noexcept { return vreinterpretq_f32_u32(a); }
    static uint32x4_t bit_of_lane() noexcept {
        constexpr std::uint32_t kBits[] = {1, 2, 4, 8};
        return vld1q_u32(kBits);
    }
};

template <>
struct PackOps<double, 2> {
    using Vector = float64x2_t;
    using MaskVector = uint64x2_t;

    static Vector broadcast(double x) noexcept { return vdupq_n_f64(x); }
    static Vector load(const double* source) noexcept { return vld1q_f64(source); }
    static void store(double* target, Vector a) noexcept { vst1q_f64(target, a); }
    static Vector gather(const double* base, const std::int32_t* indices, MaskVector active) noexcept {
        const std::uint32_t bits = mask_to_bits(active);
        double lanes[2];
        for (int i = 0; i < 2; ++i) lanes[i] = (bits >> i & 1u) != 0 ? base[indices[i]] : 0.0;
        return load(lanes);
    }

    static Vector add(Vector a, Vector b) noexcept { return vaddq_f64(a, b); }
    static Vector subtract(Vector a, Vector b) noexcept { return vsubq_f64(a, b); }
    static Vector multiply(Vector a, Vector b) noexcept { return vmulq_f64(a, b); }
    static Vector divide(Vector a, Vector b) noexcept { return vdivq_f64(a, b); }
    static Vector negate(Vector a) noexcept { return vnegq_f64(a); }
    static Vector fma(Vector a, Vector b, Vector c) noexcept { return vfmaq_f64(c, a, b); }
    static Vector sqrt(Vector a) noexcept { return vsqrtq_f64(a); }
    static Vector floor(Vector a) noexcept { return vrndmq_f64(a); }
    // The instructions for extrema return NaN where either operand is NaN.
    static Vector max(Vector a, Vector b) noexcept { return select(less(b, a), a, b); }
    static Vector min(Vector a, Vector b) noexcept { return select(less(a, b), a, b); }

    static Vector bit_and(Vector a, Vector b) noexcept {
        return from_bits(vandq_u64(to_bits(a), to_bits(b)));
    }
    static Vector bit_or(Vector a, Vector b) noexcept { return from_bits(vorrq_u64(to_bits(a), to_bits(b))); }
    static Vector bit_clear(Vector a, Vector b) noexcept {
        return from_bits(vbicq_u64(to_bits(a), to_bits(b)));
    }
    static Vector subtract_bits(Vector a, Vector b) noexcept {
        return from_bits(vsubq_u64(to_bits(a), to_bits(b)));
    }

    static MaskVector less(Vector a, Vector b) noexcept { return vcltq_f64(a, b); }
    static MaskVector less_equal(Vector a, Vector b) noexcept { return vcleq_f64(a, b); }
    static MaskVector equal(Vector a, Vector b) noexcept { return vceqq_f64(a, b); }
    static MaskVector not_equal(Vector a, Vector b) noexcept { return mask_not(vceqq_f64(a, b)); }
    static Vector select(MaskVector mask, Vector a, Vector b) noexcept { return vbslq_f64(mask, a, b); }

    static MaskVector mask_and(MaskVector a, MaskVector b) noexcept { return vandq_u64(a, b); }
    static MaskVector mask_or(MaskVector a, MaskVector b) noexcept { return vorrq_u64(a, b); }
    static MaskVector mask_xor(MaskVector a, MaskVector b) noexcept { return veorq_u64(a, b); }
    static MaskVector mask_not(MaskVector a) noexcept {
        return vreinterpretq_u64_u32(vmvnq_u32(vreinterpretq_u32_u64(a)));
    }
    static MaskVector mask_from_bits(std::uint32_t bits) noexcept {
        return vtstq_u64(vdupq_n_u64(bits), bit_of_lane());
    }
    static std::uint32_t mask_to_bits(MaskVector a) noexcept {
        return static_cast<std::uint32_t>(vaddvq_u64(vandq_u64(a, bit_of_lane())));
    }

private:
    static uint64x2_t to_bits(Vector a) noexcept { return vreinterpretq_u64_f64(a); }
    static Vector from_bits(uint64x2_t a) noexcept { return vreinterpretq_f64_u64(a); }
    static uint64x2_t bit_of_lane() noexcept {
        constexpr std::uint64_t kBits[] = {1, 2};
        return vld1q_u64(kBits);
    }
};

} // namespace detail
NUSSELT_NAMESPACE_END
#endif
