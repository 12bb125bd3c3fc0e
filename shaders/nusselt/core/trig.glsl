#ifndef NUSSELT_CORE_TRIG_GLSL
#define NUSSELT_CORE_TRIG_GLSL
// Follows include/nusselt/core/trig.h @ d194530e63a2
/// Trigonometric functions as polynomials, the same ones as in single precision on the CPU: the built-in functions of
/// GLSL may err by 4e-4 and leave special values undefined. Twin of include/nusselt/core/trig.h, where the error bounds
/// stand.

#include "../core/real.glsl"

const float kNusseltPi = 3.14159265358979;

/// Coefficients of (1 - atan(t) / t) / t^2 as a polynomial in t^2.
const float kNusseltAtanRatio[9] = float[9](3.33333018e-1, -1.99986379e-1, 1.42652367e-1, -1.09575244e-1, 8.41929077e-2,
                                            -5.82313878e-2, 3.14522795e-2, -1.10624615e-2, 1.8267392e-3);

/// 1 - atan(t) / t given s = t^2 in [0, 1], with an error relative to itself.
float one_minus_atan_ratio(float s) {
    float p = nusselt_fma(kNusseltAtanRatio[8], s, kNusseltAtanRatio[7]);
    p = nusselt_fma(p, s, kNusseltAtanRatio[6]);
    p = nusselt_fma(p, s, kNusseltAtanRatio[5]);
    p = nusselt_fma(p, s, kNusseltAtanRatio[4]);
    p = nusselt_fma(p, s, kNusseltAtanRatio[3]);
    p = nusselt_fma(p, s, kNusseltAtanRatio[2]);
    p = nusselt_fma(p, s, kNusseltAtanRatio[1]);
    p = nusselt_fma(p, s, kNusseltAtanRatio[0]);
    return s * p;
}

/// A value of one_minus_atan_ratio() and the difference to another one.
struct AtanRatioDifference {
    float value;      ///< at s
    float difference; ///< at s + step minus value, with a small error relative to itself
};

/// One step of Horner's scheme for a polynomial at s and its divided difference between s and end.
void divided_difference_step(inout float p, inout float slope, float s, float end, float coefficient) {
    p = nusselt_fma(p, s, coefficient);
    slope = nusselt_fma(slope, end, p);
}

/// \param s, step s and s + step in [0, 1].
AtanRatioDifference one_minus_atan_ratio_difference(float s, float step) {
    float end = s + step;
    float p = kNusseltAtanRatio[8];
    float slope = p;
    divided_difference_step(p, slope, s, end, kNusseltAtanRatio[7]);
    divided_difference_step(p, slope, s, end, kNusseltAtanRatio[6]);
    divided_difference_step(p, slope, s, end, kNusseltAtanRatio[5]);
    divided_difference_step(p, slope, s, end, kNusseltAtanRatio[4]);
    divided_difference_step(p, slope, s, end, kNusseltAtanRatio[3]);
    divided_difference_step(p, slope, s, end, kNusseltAtanRatio[2]);
    divided_difference_step(p, slope, s, end, kNusseltAtanRatio[1]);
    divided_difference_step(p, slope, s, end, kNusseltAtanRatio[0]);
    return AtanRatioDifference(s * p, step * slope);
}

/// Arctangent of q in [0, 1].
float atan_up_to_one(float q) { return nusselt_fma(-q, one_minus_atan_ratio(q * q), q); }

/// The smaller one of |x| and y over the larger one; 0 for the origin.
/// \param y not negative.
float octant_tangent(float y, float x) {
    float ax = abs(x);
    float large = nusselt_max(ax, y);
    return nusselt_min(ax, y) / (large > 0.0 ? large : 1.0);
}

/// Angles of both quadrants from the arctangent of octant_tangent(y, x).
float unfold_octants(float y, float x, float octant) {
    float quadrant = y > abs(x) ? kNusseltPi / 2.0 - octant : octant;
    return x < 0.0 ? kNusseltPi - quadrant : quadrant;
}

/// Angle of the point (x, y) with y >= 0, in [0, pi]; 0 for the origin. A negative or NaN y counts as 0.
float atan2_positive(float y_in, float x) {
    float y = nusselt_max(y_in, 0.0);
    return unfold_octants(y, x, atan_up_to_one(octant_tangent(y, x)));
}

/// Like atan2_positive, but with an absolute error of at most 1.3e-5 rad: for the biased variant of Peters 2021
/// (polygonal lights), Sec. 6.4.
float atan2_positive_fast(float y_in, float x) {
    float y = nusselt_max(y_in, 0.0);
    float q = octant_tangent(y, x);
    float s = q * q;
    float p = nusselt_fma(2.0845112e-2, s, -8.5156346e-2);
    p = nusselt_fma(p, s, 1.80159291e-1);
    p = nusselt_fma(p, s, -3.30304785e-1);
    p = nusselt_fma(p, s, 9.99866329e-1);
    return unfold_octants(y, x, p * q);
}

/// In C++ the members are named after the functions, which are built into GLSL.
struct SinCos {
    float sine, cosine;
};

/// Sine and cosine of an angle in [0, pi].
SinCos sincos_half_turn(float angle) {
    // angle - k pi / 2 in two steps, whose products are exact.
    float k = floor(nusselt_fma(angle, 0.636619772367581, 0.5));
    NUSSELT_PRECISE float r = (angle + k * -1.5703125) + k * -4.83826792e-4;
    float s = r * r;
    float ps = nusselt_fma(-1.95169776e-4, s, 8.33217585e-3);
    ps = nusselt_fma(ps, s, -1.66666549e-1);
    float sine = nusselt_fma(r * s, ps, r);
    float pc = nusselt_fma(2.44380910e-5, s, -1.38873645e-3);
    pc = nusselt_fma(pc, s, 4.16666468e-2);
    float cosine = nusselt_fma(s * s, pc, nusselt_fma(s, -0.5, 1.0));
    if (abs(k - 1.0) < 0.5) return SinCos(cosine, -sine);
    // Not `?:`, which WebGL forbids for structures.
    if (k > 1.5) return SinCos(-sine, -cosine);
    return SinCos(sine, cosine);
}

/// Sine and cosine of an angle in [0, pi / 2].
SinCos sincos_quarter_turn(float angle) {
    float s = angle * angle;
    float ps = nusselt_fma(2.608932605e-6, s, -1.981111272e-4);
    ps = nusselt_fma(ps, s, 8.333088167e-3);
    ps = nusselt_fma(ps, s, -1.666666046e-1);
    float pc = nusselt_fma(-2.619381449e-7, s, 2.476930420e-5);
    pc = nusselt_fma(pc, s, -1.388856916e-3);
    pc = nusselt_fma(pc, s, 4.166665577e-2);
    return SinCos(nusselt_fma(angle * s, ps, angle), nusselt_fma(s * s, pc, nusselt_fma(s, -0.5, 1.0)));
}

/// (x - sin(x)) / t^3 of the angle x = 2 atan(t).
/// \param s = t^2 in [0, 1].
float angle_minus_sine_ratio(float s) {
    float p = nusselt_fma(-4.28121388e-2, s, 2.57261246e-1);
    p = nusselt_fma(p, s, -7.13133872e-1);
    p = nusselt_fma(p, s, 1.24713326);
    p = nusselt_fma(p, s, -1.61840236);
    p = nusselt_fma(p, s, 1.7636472);
    p = nusselt_fma(p, s, -1.76994431);
    p = nusselt_fma(p, s, 1.71369636);
    p = nusselt_fma(p, s, -1.59998238);
    return nusselt_fma(p, s, 1.33333325);
}

/// x - sin(x) of the angle x = 2 atan(t) in [-pi / 2, pi / 2], with an error relative to itself.
/// \param t in [-1, 1].
float angle_minus_sine(float t) {
    float s = t * t;
    return t * s * angle_minus_sine_ratio(s);
}

#endif
