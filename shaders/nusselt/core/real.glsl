#ifndef NUSSELT_CORE_REAL_GLSL
#define NUSSELT_CORE_REAL_GLSL
// Follows include/nusselt/core/real.h @ b951d6fe63fc
/// Arithmetic with known rounding. Twin of include/nusselt/core/real.h; functions whose names GLSL has already are
/// called nusselt_*. Statements about NaN hold on devices that preserve NaN (README.md).

#include "../core/compatibility.glsl"

const float kNusseltEpsilon = 1.1920928955078125e-7; // 2^-23
const float kNusseltLargest = 3.402823466385288598e38;
const float kNusseltSmallestNormal = 1.175494350822287508e-38; // 2^-126

/// b if either operand is NaN: nusselt_max(x, 0.0) removes a NaN in x, which GLSL's max() need not do.
float nusselt_max(float a, float b) { return a > b ? a : b; }
vec3 nusselt_max(vec3 a, vec3 b) {
    return vec3(nusselt_max(a.x, b.x), nusselt_max(a.y, b.y), nusselt_max(a.z, b.z));
}
/// b if either operand is NaN.
float nusselt_min(float a, float b) { return a < b ? a : b; }
vec3 nusselt_min(vec3 a, vec3 b) {
    return vec3(nusselt_min(a.x, b.x), nusselt_min(a.y, b.y), nusselt_min(a.z, b.z));
}

/// The magnitude is not negative.
float copysign(float magnitude, float sign_source) {
    return uintBitsToFloat(floatBitsToUint(magnitude) | (floatBitsToUint(sign_source) & 0x80000000u));
}

/// Neither NaN nor infinite.
bool is_finite(float x) { return abs(x) <= kNusseltLargest; }

/// A power of two within a factor of two of 1 / x, for x > 0, clamped to normal numbers. For a power of two it is the
/// exact reciprocal, which division on a GPU need not be.
float reciprocal_power_of_two(float x) {
    uint exponent = clamp((floatBitsToUint(x) >> 23) & 0xffu, 1u, 253u);
    return uintBitsToFloat((254u - exponent) << 23);
}

/// x, or the largest number below one; 0 if x is negative or NaN.
float below_one(float x) { return nusselt_min(nusselt_max(x, 0.0), 0.999999940395355224609375); }

/// a * b + c, rounded once or twice.
float nusselt_fma(float a, float b, float c) {
    return kNusseltFusedFma ? fma(a, b, c) : a * b + c;
}
vec3 nusselt_fma(float s, vec3 a, vec3 b) {
    return kNusseltFusedFma ? fma(vec3(s), a, b) : s * a + b;
}

/// The upper 12 bits of the significand. Products of such parts, and of what they leave, are exact.
float upper_part(float x) { return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u); }
vec3 upper_part(vec3 x) { return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u); }

/// a * b - product, exact barring underflow.
/// \param product a * b, rounded.
float two_product_error(float a, float b, float product) {
    NUSSELT_PRECISE float error;
    if (kNusseltFusedFma) {
        error = fma(a, b, -product);
        return error;
    }
    // Dekker 1971, doi:10.1007/BF01397083; the halves of the factors have the same sign here.
    float ah = upper_part(a);
    float bh = upper_part(b);
    NUSSELT_PRECISE float al = a - ah;
    NUSSELT_PRECISE float bl = b - bh;
    error = ((ah * bh - product) + ah * bl + al * bh) + al * bl;
    return error;
}
vec3 two_product_error(vec3 a, vec3 b, vec3 product) {
    NUSSELT_PRECISE vec3 error;
    if (kNusseltFusedFma) {
        error = fma(a, b, -product);
        return error;
    }
    vec3 ah = upper_part(a);
    vec3 bh = upper_part(b);
    NUSSELT_PRECISE vec3 al = a - ah;
    NUSSELT_PRECISE vec3 bl = b - bh;
    error = ((ah * bh - product) + ah * bl + al * bh) + al * bl;
    return error;
}

/// s * a + b, each component rounded once up to ties.
vec3 exact_fma(float s, vec3 a, vec3 b) {
    NUSSELT_PRECISE vec3 result;
    if (kNusseltFusedFma) {
        result = fma(vec3(s), a, b);
        return result;
    }
    NUSSELT_PRECISE vec3 product = s * a;
    vec3 error = two_product_error(vec3(s), a, product);
    NUSSELT_PRECISE vec3 sum = product + b;
    NUSSELT_PRECISE vec3 added = sum - product;
    NUSSELT_PRECISE vec3 lost = (product - (sum - added)) + (b - added);
    result = sum + (lost + error);
    return result;
}

/// s * a + b with an error of two roundings of each component: faster than exact_fma().
vec3 rounded_multiply_add(float s, vec3 a, vec3 b) {
    NUSSELT_PRECISE vec3 result;
    if (kNusseltFusedFma) {
        result = fma(vec3(s), a, b);
        return result;
    }
    // Where the product and b cancel, their sum is exact.
    NUSSELT_PRECISE vec3 product = s * a;
    result = (product + b) + two_product_error(vec3(s), a, product);
    return result;
}

/// a - q * b, exact where q is a / b up to a rounding.
float division_remainder(float a, float b, float q) {
    NUSSELT_PRECISE float product = q * b;
    NUSSELT_PRECISE float remainder = (a - product) - two_product_error(q, b, product);
    return remainder;
}

/// a / b, rounded to nearest as on a CPU; division on a GPU may err by two and a half roundings.
/// \param a 0, or not much smaller or larger than 1.
/// \param b positive, likewise.
float rounded_quotient(float a, float b) {
    float q = a / b;
    q = q + division_remainder(a, b, q) / b; // the right one or a neighbour
    float remainder = division_remainder(a, b, q);
    if (remainder == 0.0) return q;
    uint bits = floatBitsToUint(q);
    float neighbour = uintBitsToFloat(remainder > 0.0 ? bits + 1u : bits - 1u);
    return abs(division_remainder(a, b, neighbour)) < abs(remainder) ? neighbour : q;
}

#if !defined(GL_ES) || __VERSION__ >= 320
/// Whether fma() rounds once on this device, which is the value for NUSSELT_FUSED_FMA.
/// \param x 1.000244140625, from a buffer or uniform: compilers evaluate constants by other means than the device.
bool nusselt_fma_is_fused(float x) {
    NUSSELT_PRECISE float error = fma(x, x, -1.00048828125);
    return error > 0.0;
}
#endif

#endif
