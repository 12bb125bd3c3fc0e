#pragma once
/// Pack<T, N>: N independent lanes of float or double with the operations of core/real.h, and its Mask<T, N>.
///
/// Every (T, N) with N <= 32 compiles for every instruction set. Those with registers of their own use
/// intrinsics (float 4, 8, 16 and double 2, 4, 8 as far as the compiler's flags allow), multiples of the widest one
/// are made of several registers, the others of arrays.
/// A lane never influences another: NaN and infinities stay where they are. Each lane holds the bits that the
/// scalar function of core/real.h gives in the same translation unit, apart from the payload and sign of NaN
/// that arithmetic makes or passes on.
///
/// Functions are friends and found by argument-dependent lookup: write `sqrt(x)`, not `nusselt::sqrt(x)`.

#include <cstdint>
#include <limits>
#include <type_traits>

#include <nusselt/core/real.h>
#include <nusselt/simd/pack_avx2.h>
#include <nusselt/simd/pack_avx512.h>
#include <nusselt/simd/pack_generic.h>
#include <nusselt/simd/pack_neon.h>
#include <nusselt/simd/pack_pair.h>
#include <nusselt/simd/pack_sse.h>
#include <nusselt/simd/pack_wasm.h>

NUSSELT_NAMESPACE_BEGIN

template <class T, int N>
class Pack;

/// One truth value per lane of a Pack<T, N>. `Mask m;` is uninitialised, `Mask m{}` is false in every lane.
template <class T, int N>
class Mask {
    using Ops = detail::PackOps<T, N>;

public:
    using Native = typename Ops::MaskVector;

    Mask() = default;

    /// The same value in every lane. Takes nothing but bool, so that no number or pointer becomes a mask.
    template <class Bool, std::enable_if_t<std::is_same_v<Bool, bool>, int> = 0>
    Mask(Bool value) noexcept : Mask(from_bits(value ? ~std::uint32_t{0} : 0)) {}

    /// Lane i is bit i, least significant first; bits beyond the last lane are ignored.
    static Mask from_bits(std::uint32_t bits) noexcept { return from_native(Ops::mask_from_bits(bits)); }
    /// Bit i is lane i; bits beyond the last lane are 0.
    std::uint32_t bits() const noexcept { return Ops::mask_to_bits(native_); }

    /// \param i  in [0, N)
    bool lane(int i) const noexcept { return (bits() >> i & 1u) != 0; }
    /// \param i  in [0, N)
    void set_lane(int i, bool value) noexcept {
        const std::uint32_t others = bits() & ~(std::uint32_t{1} << i);
        *this = from_bits(others | std::uint32_t{value} << i);
    }

    /// The register (or array) itself, for code written for one instruction set.
    static Mask from_native(Native native) noexcept {
        Mask result;
        result.native_ = native;
        return result;
    }
    Native native() const noexcept { return native_; }

    friend Mask operator&(Mask a, Mask b) noexcept {
        return from_native(Ops::mask_and(a.native_, b.native_));
    }
    friend Mask operator|(Mask a, Mask b) noexcept { return from_native(Ops::mask_or(a.native_, b.native_)); }
    friend Mask operator^(Mask a, Mask b) noexcept {
        return from_native(Ops::mask_xor(a.native_, b.native_));
    }
    friend Mask operator!(Mask a) noexcept { return from_native(Ops::mask_not(a.native_)); }
    Mask& operator&=(Mask b) noexcept { return *this = *this & b; }
    Mask& operator|=(Mask b) noexcept { return *this = *this | b; }

    friend bool any(Mask a) noexcept { return a.bits() != 0; }
    friend bool all(Mask a) noexcept { return a.bits() == kAllLanes; }

private:
    static constexpr std::uint32_t kAllLanes = ~std::uint32_t{0} >> (32 - N);

    Native native_;
};

/// N lanes of T. `Pack p;` is uninitialised, `Pack p{}` is zero, as for a scalar.
template <class T, int N>
class Pack {
    using Ops = detail::PackOps<T, N>;

public:
    using Native = typename Ops::Vector;

    Pack() = default;

    /// x in every lane. Implicit, so that scalars mix with packs in expressions.
    Pack(T x) noexcept : native_(Ops::broadcast(x)) {}
    /// x, rounded to T, in every lane: `Real(0.5)` is right for every Real.
    template <class Number,
              std::enable_if_t<std::is_arithmetic_v<Number> && !std::is_same_v<Number, T>, int> = 0>
    explicit Pack(Number x) noexcept : Pack(static_cast<T>(x)) {}

    /// Reads N values; any alignment that T allows.
    static Pack load(const T* source) noexcept { return from_native(Ops::load(source)); }
    /// Writes N values; any alignment that T allows.
    void store(T* target) const noexcept { Ops::store(target, native_); }

    /// Lane i is base[indices[i]]. Reads N indices.
    static Pack gather(const T* base, const std::int32_t* indices) noexcept {
        return gather(base, indices, Mask<T, N>(true));
    }
    /// Lane i is base[indices[i]] where active, else 0. The index of an inactive lane may be anything: all N
    /// indices are read, but base only where active.
    static Pack gather(const T* base, const std::int32_t* indices, Mask<T, N> active) noexcept {
        return from_native(Ops::gather(base, indices, active.native()));
    }

    /// \param i  in [0, N)
    T lane(int i) const noexcept {
        T lanes[N];
        store(lanes);
        return lanes[i];
    }
    /// \param i  in [0, N)
    void set_lane(int i, T x) noexcept {
        T lanes[N];
        store(lanes);
        lanes[i] = x;
        *this = load(lanes);
    }

    /// The register (or array) itself, for code written for one instruction set.
    static Pack from_native(Native native) noexcept {
        Pack result;
        result.native_ = native;
        return result;
    }
    Native native() const noexcept { return native_; }

    friend Pack operator+(Pack a, Pack b) noexcept { return from_native(Ops::add(a.native_, b.native_)); }
    friend Pack operator-(Pack a, Pack b) noexcept {
        return from_native(Ops::subtract(a.native_, b.native_));
    }
    friend Pack operator*(Pack a, Pack b) noexcept {
        return from_native(Ops::multiply(a.native_, b.native_));
    }
    friend Pack operator/(Pack a, Pack b) noexcept { return from_native(Ops::divide(a.native_, b.native_)); }
    friend Pack operator-(Pack a) noexcept { return from_native(Ops::negate(a.native_)); }
    Pack& operator+=(Pack b) noexcept { return *this = *this + b; }
    Pack& operator-=(Pack b) noexcept { return *this = *this - b; }
    Pack& operator*=(Pack b) noexcept { return *this = *this * b; }
    Pack& operator/=(Pack b) noexcept { return *this = *this / b; }

    /// Comparisons with NaN are false, except !=.
    friend Mask<T, N> operator<(Pack a, Pack b) noexcept { return to_mask(Ops::less(a.native_, b.native_)); }
    friend Mask<T, N> operator<=(Pack a, Pack b) noexcept {
        return to_mask(Ops::less_equal(a.native_, b.native_));
    }
    friend Mask<T, N> operator>(Pack a, Pack b) noexcept { return b < a; }
    friend Mask<T, N> operator>=(Pack a, Pack b) noexcept { return b <= a; }
    friend Mask<T, N> operator==(Pack a, Pack b) noexcept {
        return to_mask(Ops::equal(a.native_, b.native_));
    }
    friend Mask<T, N> operator!=(Pack a, Pack b) noexcept {
        return to_mask(Ops::not_equal(a.native_, b.native_));
    }

    /// a where the mask is set, else b.
    friend Pack select(Mask<T, N> mask, Pack a, Pack b) noexcept {
        return from_native(Ops::select(mask.native(), a.native_, b.native_));
    }

    friend Pack sqrt(Pack x) noexcept { return from_native(Ops::sqrt(x.native_)); }
    friend Pack floor(Pack x) noexcept { return from_native(Ops::floor(x.native_)); }
    friend Pack abs(Pack x) noexcept { return from_native(Ops::bit_clear(x.native_, sign_bit().native_)); }
    friend Pack copysign(Pack magnitude, Pack sign) noexcept {
        return from_native(
            Ops::bit_or(abs(magnitude).native_, Ops::bit_and(sign.native_, sign_bit().native_)));
    }

    /// b if either operand is NaN or both are zeros, as the x86 instructions.
    friend Pack max(Pack a, Pack b) noexcept { return from_native(Ops::max(a.native_, b.native_)); }
    /// b if either operand is NaN or both are zeros, as the x86 instructions.
    friend Pack min(Pack a, Pack b) noexcept { return from_native(Ops::min(a.native_, b.native_)); }

    /// a * b + c as the scalar fma in core/real.h: rounded once, by the instruction where there is one.
    friend Pack fma(Pack a, Pack b, Pack c) noexcept {
        return from_native(Ops::fma(a.native_, b.native_, c.native_));
    }

    /// a * b + c as the scalar multiply_add in core/real.h: rounded once where that is fastest, else twice.
    friend Pack multiply_add(Pack a, Pack b, Pack c) noexcept {
#if NUSSELT_HAS_FMA
        return fma(a, b, c);
#else
        return a * b + c;
#endif
    }

    /// a * b - c * d as the scalar function in core/real.h.
    friend Pack difference_of_products(Pack a, Pack b, Pack c, Pack d) noexcept {
        if constexpr (!NUSSELT_HAS_FMA && std::is_same_v<T, float>) {
            return from_native(Ops::difference_of_products(a.native_, b.native_, c.native_, d.native_));
        } else {
            const Pack cd = c * d;
            const Pack error = fma(c, d, -cd);
            return fma(a, b, -cd) - error;
        }
    }

    /// Whether a lane is neither NaN nor infinite.
    friend Mask<T, N> is_finite(Pack x) noexcept { return abs(x) <= Pack(std::numeric_limits<T>::max()); }

    /// See the scalar function in core/real.h.
    friend Pack reciprocal_power_of_two(Pack x) noexcept {
        // Infinity is the mask of the exponent bits: what remains of x is 0, a power of two or infinity.
        // Biased exponents e and 2 * bias - e belong to reciprocal powers.
        constexpr T kSmallest = std::numeric_limits<T>::min();
        constexpr T kLargest = 1 / kSmallest;
        constexpr T kTwiceBias = 2 * kLargest;
        const Pack power =
            from_native(Ops::bit_and(x.native_, Pack(std::numeric_limits<T>::infinity()).native_));
        const Pack clamped = max(min(power, Pack(kLargest)), Pack(kSmallest));
        return from_native(Ops::subtract_bits(Pack(kTwiceBias).native_, clamped.native_));
    }

private:
    static Pack sign_bit() noexcept { return Pack(-T(0)); }
    static Mask<T, N> to_mask(typename Ops::MaskVector native) noexcept {
        return Mask<T, N>::from_native(native);
    }

    Native native_;
};

template <class T, int N>
struct RealTraits<Pack<T, N>> {
    using Scalar = T;
    using Mask = nusselt::Mask<T, N>;
    static constexpr int kLanes = N;
};

NUSSELT_NAMESPACE_END
