#pragma once
/// The requirements of the library on number types. `Real` is float, double, long double, or a pack of float or double
/// with one independent lane per light and shading point.
///
/// Templates use the operations below by unqualified name: this header has them for scalars, simd/pack.h for
/// packs (found by argument-dependent lookup). Comparisons give a mask: bool for scalars.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include <nusselt/core/config.h>

// 1 where std::sqrt() is a call of the library although the target has an instruction.
#if defined(__SSE2__) && !defined(__NO_MATH_ERRNO__) && !defined(__CUDACC__) && !defined(__CUDA__)
#define NUSSELT_HAS_SQRT_INSTRUCTION 1
#include <emmintrin.h>
#else
#define NUSSELT_HAS_SQRT_INSTRUCTION 0
#endif

NUSSELT_NAMESPACE_BEGIN

/// Maps a number type to its scalar, its mask and its number of lanes. simd/pack.h specialises it.
template <class Real>
struct RealTraits {
    static_assert(std::is_floating_point_v<Real>,
                  "Real must be float, double, long double or a Pack of them");
    using Scalar = Real;
    using Mask = bool;
    static constexpr int kLanes = 1;
};

template <class Real>
using scalar_t = typename RealTraits<Real>::Scalar;
template <class Real>
using mask_t = typename RealTraits<Real>::Mask;

/// 2^exponent, for constants.
template <class Scalar>
constexpr Scalar power_of_two(int exponent) noexcept {
    Scalar result = 1;
    for (int i = 0; i < exponent; ++i) result *= 2;
    for (int i = 0; i > exponent; --i) result /= 2;
    return result;
}

template <class T>
using EnableScalar = std::enable_if_t<std::is_floating_point_v<T>, int>;

/// a where the mask is set, else b. Both are evaluated.
template <class T, EnableScalar<T> = 0>
NUSSELT_HD constexpr T select(bool mask, T a, T b) noexcept {
    return mask ? a : b;
}
NUSSELT_HD constexpr bool any(bool mask) noexcept { return mask; }
NUSSELT_HD constexpr bool all(bool mask) noexcept { return mask; }

#if NUSSELT_HAS_SQRT_INSTRUCTION
namespace detail {

/// std::sqrt() sets errno, for which compilers call the library, so that all registers have to be saved somewhere even if
/// no argument is ever negative.
NUSSELT_INLINE float sqrt_instruction(float x) noexcept {
#if defined(__clang__) || !defined(__GNUC__)
    return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x)));
#elif defined(__AVX__)
    __asm__("vsqrtss %0, %0, %0" : "+x"(x));
    return x;
#else
    // The intrinsic would clear the upper part of the register by way of another one.
    __asm__("sqrtss %0, %0" : "+x"(x));
    return x;
#endif
}
/// \copydoc sqrt_instruction(float)
NUSSELT_INLINE double sqrt_instruction(double x) noexcept {
#if defined(__clang__) || !defined(__GNUC__)
    return _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(x)));
#elif defined(__AVX__)
    __asm__("vsqrtsd %0, %0, %0" : "+x"(x));
    return x;
#else
    __asm__("sqrtsd %0, %0" : "+x"(x));
    return x;
#endif
}

} // namespace detail
#endif

template <class T, EnableScalar<T> = 0>
NUSSELT_INLINE T sqrt(T x) noexcept {
#if NUSSELT_HAS_SQRT_INSTRUCTION
    if constexpr (!std::is_same_v<T, long double>) return detail::sqrt_instruction(x);
#endif
    return std::sqrt(x);
}
template <class T, EnableScalar<T> = 0>
NUSSELT_INLINE T abs(T x) noexcept {
    return std::fabs(x);
}
template <class T, EnableScalar<T> = 0>
NUSSELT_INLINE T floor(T x) noexcept {
    return std::floor(x);
}
template <class T, EnableScalar<T> = 0>
NUSSELT_INLINE T copysign(T magnitude, T sign) noexcept {
    return std::copysign(magnitude, sign);
}

/// b if either operand is NaN or both are zeros, as the x86 instructions: max(x, 0) removes a NaN in x.
template <class T, EnableScalar<T> = 0>
NUSSELT_HD constexpr T max(T a, T b) noexcept {
    return a > b ? a : b;
}
/// b if either operand is NaN or both are zeros.
template <class T, EnableScalar<T> = 0>
NUSSELT_HD constexpr T min(T a, T b) noexcept {
    return a < b ? a : b;
}

namespace detail {

NUSSELT_INLINE float round_to_float(double x) noexcept {
    auto rounded = static_cast<float>(x);
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDA_ARCH__) && defined(__SSE2__)
    // g++ 12 vectorises neighbouring calls and forgets to round what is an operand of another call: without this,
    // TriangleShadow.PacksHaveTheBitsOfScalars fails for x86-64-v2.
    __asm__("" : "+x"(rounded));
#endif
    return rounded;
}

} // namespace detail

/// a * b + c, rounded once. Without the instruction, float goes through double: the product is exact there
/// and the result differs from a true fma by at most one rounding in 2^29 cases, while the library routine
/// would take a hundred nanoseconds. Where two roundings do no harm, multiply_add() is faster.
NUSSELT_INLINE float fma(float a, float b, float c) noexcept {
#if NUSSELT_HAS_FMA
    return std::fma(a, b, c);
#else
    return detail::round_to_float(static_cast<double>(a) * static_cast<double>(b) + static_cast<double>(c));
#endif
}
NUSSELT_INLINE double fma(double a, double b, double c) noexcept { return std::fma(a, b, c); }
/// There is no instruction, and a library routine would take 400 ns: this uses the product as an exact sum of two
/// numbers (Dekker 1971), whose larger one is added first. In difference_of_products() the result is the same; in
/// general it may be the other neighbour of the exact value.
NUSSELT_HD inline long double fma(long double a, long double b, long double c) noexcept {
    if constexpr (std::numeric_limits<long double>::digits == std::numeric_limits<double>::digits) {
        return std::fma(a, b, c);
    } else {
        constexpr int kHalf = (std::numeric_limits<long double>::digits + 1) / 2;
        constexpr long double kSplitter = static_cast<long double>(std::uint64_t{1} << kHalf) + 1;
        const auto high = [](long double x) {
            const long double shifted = kSplitter * x;
            return shifted - (shifted - x);
        };
        const long double product = a * b;
        const long double ah = high(a), bh = high(b);
        const long double al = a - ah, bl = b - bh;
        const long double error = ((ah * bh - product) + ah * bl + al * bh) + al * bl;
        const long double sum = product + c;
        const long double added = sum - product;
        const long double lost = (product - (sum - added)) + (c - added);
        return sum + (lost + error);
    }
}

/// a * b + c as fast as the processor can: rounded once where it has an instruction for that, else twice. For
/// polynomials and other sums whose error bounds do not need the exact product.
template <class T, EnableScalar<T> = 0>
NUSSELT_INLINE constexpr T multiply_add(T a, T b, T c) noexcept {
#if NUSSELT_HAS_FMA
    if constexpr (!std::is_same_v<T, long double>)
        if (!__builtin_is_constant_evaluated()) return std::fma(a, b, c);
#endif
    return a * b + c;
}

/// a * b - c * d with an error of at most 1.5 ulp barring under- and overflow, and never the wrong sign
/// (Kahan's algorithm; Jeannerod, Louvet, Muller 2013, doi:10.1090/S0025-5718-2013-02679-8).
template <class T, EnableScalar<T> = 0>
NUSSELT_INLINE T difference_of_products(T a, T b, T c, T d) noexcept {
#if !NUSSELT_HAS_FMA
    // Both products are exact in double precision.
    if constexpr (std::is_same_v<T, float>) {
        return detail::round_to_float(static_cast<double>(a) * static_cast<double>(b) -
                                      static_cast<double>(c) * static_cast<double>(d));
    }
#endif
    const T cd = c * d;
    const T error = fma(c, d, -cd);
    return fma(a, b, -cd) - error;
}

/// Whether x is neither NaN nor infinite.
template <class T, EnableScalar<T> = 0>
NUSSELT_INLINE bool is_finite(T x) noexcept {
    return abs(x) <= std::numeric_limits<T>::max();
}

/// Reciprocal of the largest power of two that is at most x, for x > 0: x times the result is in [1, 2), and 1 if
/// x is a power of two. Clamped to normal numbers, so that this holds unless x is denormal or above 2^126; finite and
/// positive for 0. Multiplying by it introduces no rounding.
NUSSELT_INLINE float reciprocal_power_of_two(float x) noexcept {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    std::uint32_t exponent = (bits >> 23) & 0xffu;
    exponent = exponent < 1u ? 1u : exponent > 253u ? 253u : exponent;
    bits = (254u - exponent) << 23;
    float result = 0;
    std::memcpy(&result, &bits, sizeof bits);
    return result;
}
/// \copydoc reciprocal_power_of_two(float)
NUSSELT_INLINE double reciprocal_power_of_two(double x) noexcept {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    std::uint64_t exponent = (bits >> 52) & 0x7ffu;
    exponent = exponent < 1u ? 1u : exponent > 2045u ? 2045u : exponent;
    bits = (2046u - exponent) << 52;
    double result = 0;
    std::memcpy(&result, &bits, sizeof bits);
    return result;
}
/// \copydoc reciprocal_power_of_two(float)
inline long double reciprocal_power_of_two(long double x) noexcept {
    int exponent = 0;
    std::frexp(x, &exponent);
    constexpr int kLimit = std::numeric_limits<long double>::max_exponent - 2;
    exponent = exponent - 1 < -kLimit ? -kLimit : exponent - 1 > kLimit ? kLimit : exponent - 1;
    return std::ldexp(1.0L, -exponent);
}

/// x, or the largest number below one: brings the result of an inversion back to [0, 1). A negative x or NaN
/// becomes 0.
template <class Real>
NUSSELT_INLINE Real below_one(const Real& x) noexcept {
    constexpr scalar_t<Real> kLargest = 1 - std::numeric_limits<scalar_t<Real>>::epsilon() / 2;
    return min(max(x, Real(0)), Real(kLargest));
}

NUSSELT_NAMESPACE_END
