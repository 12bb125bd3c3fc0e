#pragma once
/// Namespaces and function qualifiers shared by every header of the library.

#if __cplusplus < 201703L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 201703L)
#error nusselt needs C++17: add -std=c++17 or /std:c++17
#endif

/// Functions carry NUSSELT_HD so that CUDA compiles them for host and device.
#if defined(__clang__) && defined(__CUDA__)
#define NUSSELT_HD __attribute__((host)) __attribute__((device))
#elif defined(__CUDACC__)
#define NUSSELT_HD __host__ __device__
#else
#define NUSSELT_HD
#endif

/// Small functions on vectors are inlined in any case: g++ leaves larger callers of them as calls, whose results go
/// through memory in pieces and are read back whole, which costs more than the functions themselves.
#if defined(_MSC_VER)
#define NUSSELT_INLINE __forceinline
#elif defined(__CUDACC__) && !defined(__clang__)
#define NUSSELT_INLINE NUSSELT_HD __forceinline__
#else
#define NUSSELT_INLINE NUSSELT_HD inline __attribute__((always_inline))
#endif

/// 1 if the target has an instruction for a * b + c with one rounding.
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA) || defined(__CUDA_ARCH__)
#define NUSSELT_HAS_FMA 1
#else
#define NUSSELT_HAS_FMA 0
#endif

/// 1 where scalar code for float takes the vertices of a light as lanes of a register: on CPUs.
#if defined(__CUDACC__) || defined(__CUDA__)
#define NUSSELT_HAS_VERTEX_LANES 0
#else
#define NUSSELT_HAS_VERTEX_LANES 1
#endif

/// Everything lives in an inline namespace named after the instruction set of the translation unit. A program
/// may compile the library for several instruction sets; without distinct names the linker would merge their
/// inline functions and could give the baseline a copy that needs AVX-512.
#if defined(__CUDACC__) || defined(__CUDA__)
// Host and device share it, so that kernels whose types are the library's have the same name on both.
#define NUSSELT_ISA isa_cuda
#elif defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define NUSSELT_ISA isa_avx512
#elif defined(__AVX2__) && defined(__FMA__)
#define NUSSELT_ISA isa_avx2
#elif defined(__AVX__) && defined(__FMA__)
#define NUSSELT_ISA isa_avx_fma
#elif defined(__AVX__)
#define NUSSELT_ISA isa_avx
#elif defined(__SSE4_2__)
#define NUSSELT_ISA isa_sse42
#elif defined(__aarch64__) && defined(__ARM_NEON)
#define NUSSELT_ISA isa_neon
#elif defined(__wasm_simd128__)
#define NUSSELT_ISA isa_wasm_simd128
#else
#define NUSSELT_ISA isa_generic
#endif

#define NUSSELT_NAMESPACE_BEGIN                                                                              \
    namespace nusselt {                                                                                      \
    inline namespace NUSSELT_ISA {
#define NUSSELT_NAMESPACE_END                                                                                \
    }                                                                                                        \
    }

/// Before a loop over the vertices or sectors of a light: with constant indices, packs stay in registers.
#if defined(__CUDACC__) || defined(__clang__)
#define NUSSELT_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define NUSSELT_UNROLL _Pragma("GCC unroll 16")
#else
#define NUSSELT_UNROLL
#endif

/// Error-free products, infinities, NaN and the sign of zero mean what IEEE 754 defines. Contraction into fma
/// (-ffp-contract=fast, the default of g++) is fine. clang and nvcc do not report every such option: never give
/// clang -fassociative-math, -freciprocal-math or -fno-signed-zeros alone, nor nvcc --use_fast_math.
#if defined(__FAST_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) ||                \
    defined(_M_FP_FAST) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error nusselt needs IEEE arithmetic: no -ffast-math, -Ofast or /fp:fast; add -fno-fast-math to files that include it
#endif
