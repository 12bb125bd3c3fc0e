#ifndef NUSSELT_RANDOM_UNIT_INTERVAL_GLSL
#define NUSSELT_RANDOM_UNIT_INTERVAL_GLSL
// Follows include/nusselt/random/unit_interval.h @ 275ec9c7a156
/// Converts random bits to numbers in [0, 1). Twin of include/nusselt/random/unit_interval.h.

#include "../core/real.glsl"

/// A number in [0, 1), never 1: the highest 24 bits. Exact.
float to_unit(uint bits) { return float(bits >> 8) * 5.9604644775390625e-8; }

/// (u + k) / n, brought back into [k / n, (k + 1) / n) where rounding leaves it: point k of n that share u. The same
/// bits as in C++.
/// \param u in [0, 1).
/// \param k below n.
/// \param n at least 1, at most 2^23.
float uniform_jittered(float u, uint k, uint n) {
    float begin = float(k);
    float count = float(n);
    // The product rounds to the number before the end of the stratum.
    float largest = rounded_quotient(begin + 1.0, count) * 0.999999940395355224609375;
    float jittered = rounded_quotient(u + begin, count);
    return jittered < largest ? jittered : largest;
}

#endif
