#ifndef NUSSELT_CORE_EXPONENTIAL_GLSL
#define NUSSELT_CORE_EXPONENTIAL_GLSL
// Follows include/nusselt/core/exponential.h @ f464b9d85f53
/// Powers of cosines with any real exponent, also huge ones, by the polynomials of single precision on the CPU. Twin of
/// include/nusselt/core/exponential.h, where the error bounds stand.

#include "../core/trig.glsl"

/// log((1 + z) / (1 - z)) for z in [0, 1/3].
float doubled_artanh(float z) {
    float s = z * z;
    float p = 1.0 / 13.0;
    p = nusselt_fma(p, s, 1.0 / 11.0);
    p = nusselt_fma(p, s, 1.0 / 9.0);
    p = nusselt_fma(p, s, 1.0 / 7.0);
    p = nusselt_fma(p, s, 1.0 / 5.0);
    p = nusselt_fma(p, s, 1.0 / 3.0);
    return 2.0 * nusselt_fma(p * s, z, z);
}

/// -log(cosine) of an angle in [0, pi / 2], accurate relative to itself also for small angles; at least 34 and finite
/// for the right angle.
float negative_log_of_cosine(const SinCos angle) {
    float squared = angle.sine * angle.sine;
    if (squared <= 0.5) return 0.5 * doubled_artanh(squared / (2.0 - squared));
    float cosine = nusselt_max(angle.cosine, 1e-15);
    float power = reciprocal_power_of_two(cosine);
    float mantissa = power * cosine;
    float fraction = doubled_artanh((mantissa - 1.0) / (mantissa + 1.0));
    float exponent = float(int(floatBitsToUint(power) >> 23) - 127);
    return 6.931471806e-1 * exponent - fraction;
}

/// exp(-x) for x >= 0; 0 for x of 87 and more.
float exp_of_negative(float x) {
    if (!(x < 87.0)) return 0.0;
    float exponent = floor(nusselt_fma(x, 1.442695041, 0.5));
    // ln(2) as the sum of two floats, the first of which has zeros at its end.
    float r = nusselt_fma(exponent, -3.194618330e-5, nusselt_fma(exponent, -0.693115234375, x));
    float p = -1.0 / 5040.0;
    p = nusselt_fma(p, r, 1.0 / 720.0);
    p = nusselt_fma(p, r, -1.0 / 120.0);
    p = nusselt_fma(p, r, 1.0 / 24.0);
    p = nusselt_fma(p, r, -1.0 / 6.0);
    p = nusselt_fma(p, r, 0.5);
    p = nusselt_fma(p, r, -1.0);
    p = nusselt_fma(p, r, 1.0);
    return p * uintBitsToFloat(uint(127 - int(exponent)) << 23);
}

#endif
