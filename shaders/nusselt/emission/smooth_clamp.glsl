#ifndef NUSSELT_EMISSION_SMOOTH_CLAMP_GLSL
#define NUSSELT_EMISSION_SMOOTH_CLAMP_GLSL
// Follows include/nusselt/emission/smooth_clamp.h @ e6c9103ff1a0
/// A clamp that stays positive, for weights. Twin of include/nusselt/emission/smooth_clamp.h.

#include "../core/trig.glsl"

/// About the mean of max(0, X) for a normal X: (mean + sqrt(mean^2 + 2 variance / pi)) / 2. Positive if the variance
/// is.
float smooth_clamp(float mean, float variance) {
    float root = sqrt(nusselt_fma(mean, mean, (2.0 / kNusseltPi) * variance));
    float sum = root + abs(mean);
    // Where the mean is negative, the sum would cancel.
    return mean >= 0.0 ? 0.5 * sum : (1.0 / kNusseltPi) * variance / sum;
}
vec4 smooth_clamp(vec4 mean, vec4 variance) {
    return vec4(smooth_clamp(mean.x, variance.x), smooth_clamp(mean.y, variance.y), smooth_clamp(mean.z, variance.z),
                smooth_clamp(mean.w, variance.w));
}

#endif
