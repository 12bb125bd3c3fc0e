#ifndef NUSSELT_RELATED_PETERS_ARITHMETIC_GLSL
#define NUSSELT_RELATED_PETERS_ARITHMETIC_GLSL
// Follows include/nusselt/related/peters_arithmetic.h @ a20beaa2ab81
/// Arithmetic of the published formulas of Peters 2021, as fast as the device allows: what a user would write who does
/// without the guarantees of core/trig.glsl and core/vec.glsl. Twin of include/nusselt/related/peters_arithmetic.h.

#include "../core/trig.glsl"
#include "../core/vec.glsl"

/// Kahan's algorithm where fma rounds once.
float peters_det(vec2 a, vec2 b) { return kNusseltFusedFma ? det(a, b) : a.x * b.y - a.y * b.x; }
/// \copydoc peters_det
vec3 peters_cross(vec3 a, vec3 b) { return kNusseltFusedFma ? nusselt_cross(a, b) : cross(a, b); }

/// Angle of the point (x, y) with y >= 0; a negative y counts as 0. The polynomial has a relative error of 1.2e-7 and,
/// by Estrin's scheme, short chains.
float peters_atan2_positive(float y_in, float x) {
    float y = nusselt_max(y_in, 0.0);
    float ax = abs(x);
    float q = nusselt_min(ax, y) / nusselt_max(ax, y);
    float s = q * q;
    float s2 = s * s;
    float low = nusselt_fma(nusselt_fma(-0.140032902, s, 0.199669618), s2, nusselt_fma(-0.333318127, s, 0.999999882));
    float high =
        nusselt_fma(nusselt_fma(-0.00455979199, s, 0.0237805186), s2, nusselt_fma(-0.0588297531, s, 0.0986886546));
    float octant = q * nusselt_fma(high, s2 * s2, low);
    float quadrant = y > ax ? 0.5 * kNusseltPi - octant : octant;
    return x < 0.0 ? kNusseltPi - quadrant : quadrant;
}

/// \param w_t cosine of the arcsine of w_s.
float peters_arcsine(float w_s, float w_t) { return copysign(peters_atan2_positive(abs(w_s), w_t), w_s); }

/// Of angles in [-pi / 2, pi / 2]: the polynomials of sincos_quarter_turn() in shorter chains.
SinCos peters_sincos_around_zero(float x) {
    float s = x * x;
    float s2 = s * s;
    float s3 = s2 * s;
    float ps = nusselt_fma(nusselt_fma(-1.981111272e-4, s, 8.333088167e-3), s, -1.666666046e-1);
    float sine = nusselt_fma(2.608932605e-6, s3, ps);
    float pc = nusselt_fma(nusselt_fma(2.476930420e-5, s, -1.388856916e-3), s, 4.166665577e-2);
    float cosine = nusselt_fma(-2.619381449e-7, s3, pc);
    return SinCos(nusselt_fma(x * s, sine, x), nusselt_fma(s2, cosine, nusselt_fma(s, -0.5, 1.0)));
}

/// Of angles in [0, pi].
SinCos peters_sincos_half_turn(float angle) {
    float folded = nusselt_min(angle, kNusseltPi - angle);
    SinCos result = peters_sincos_around_zero(folded);
    return SinCos(result.sine, folded < angle ? -result.cosine : result.cosine);
}

#endif
