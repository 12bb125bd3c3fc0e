#ifndef NUSSELT_CONES_CYCLOID_GLSL
#define NUSSELT_CONES_CYCLOID_GLSL
// Follows include/nusselt/cones/cycloid.h @ bc1ef85c6421
/// The cycloid x - sin(x) and its inverse: the distribution of the angle from a pole on the horizon, weighted by the
/// cosine at the surface. Twin of include/nusselt/cones/cycloid.h.

#include "../core/trig.glsl"

/// Cube root of x in [0, 20]: relative error at most 3e-7 above 1e-6 and 3e-6 above 1e-9, absolute error at most 2e-4
/// below.
float cube_root(float x) {
    // x^(5/16) is close enough for two steps of Halley's method.
    float fourth = sqrt(sqrt(x));
    float r = 0.86 * fourth * sqrt(sqrt(fourth));
    NUSSELT_LOOP for (int i = 0; i < 2; ++i) {
        float cube = r * r * r;
        float denominator = cube + cube + x;
        r = r * ((cube + (x + x)) / (denominator > 0.0 ? denominator : 1.0));
    }
    return r;
}

/// The inverse of the cycloid over its argument z = cbrt(6 y), as a polynomial in z^2; relative error 8e-8 for y <= pi.
float inverse_cycloid_ratio(float s) {
    float p = nusselt_fma(1.95707355e-9, s, -3.92543666e-8);
    p = nusselt_fma(p, s, 3.80596054e-7);
    p = nusselt_fma(p, s, -1.64838031e-6);
    p = nusselt_fma(p, s, 7.53784436e-6);
    p = nusselt_fma(p, s, 3.19933824e-5);
    p = nusselt_fma(p, s, 7.20078958e-4);
    p = nusselt_fma(p, s, 1.66649979e-2);
    return nusselt_fma(p, s, 1.00000008);
}

/// (x - sin(x)) / t^3 with x = 2 angle and t = tan(angle), or over sin(angle)^3 above 45 degrees.
struct CycloidRatio {
    float value;
    bool is_small; ///< whether it is over the tangent
};

/// \param sine, cosine of an angle in [0, pi); exactly the angle that is given as well.
CycloidRatio cycloid_ratio(float angle, float sine, float cosine) {
    if (sine < cosine) {
        float t = sine / cosine;
        return CycloidRatio(angle_minus_sine_ratio(t * t), true);
    }
    float cube = sine * sine * sine;
    return CycloidRatio(2.0 * (angle - sine * cosine) / (cube > 0.0 ? cube : 1.0), false);
}

/// x - sin(x) over t^3 as above: the ratio, divided by the cube of the cosine where it is over the tangent.
float cycloid_over_cubed_sine(float angle, float sine, float cosine) {
    CycloidRatio ratio = cycloid_ratio(angle, sine, cosine);
    float divisor = ratio.is_small ? cosine : 1.0;
    return ratio.value / (divisor * divisor * divisor);
}

/// x - sin(x) for x = 2 angle, as a fraction of x^3 / 6, in [0.15, 1].
float cycloid_fraction(float angle, float sine, float cosine) {
    if (!(angle > 0.0)) return 1.0;
    CycloidRatio ratio = cycloid_ratio(angle, sine, cosine);
    float per_angle = (ratio.is_small ? sine / cosine : sine) / angle;
    return 0.75 * ratio.value * per_angle * per_angle * per_angle;
}

/// The angle for which 2 angle - sin(2 angle) is u times that of the largest angle.
/// \param largest  in [0, pi).
/// \param fraction cycloid_fraction() of it.
float inverse_cycloid(float u, float largest, float fraction) {
    float x_largest = largest + largest;
    float y = u * fraction * (x_largest * x_largest * x_largest); // six times
    bool upper = y > 6.0 * kNusseltPi;
    float z = upper ? cube_root(nusselt_max(12.0 * kNusseltPi - y, 0.0)) : x_largest * cube_root(u * fraction);
    float x = z * inverse_cycloid_ratio(z * z);
    return nusselt_min(0.5 * (upper ? 2.0 * kNusseltPi - x : x), largest);
}

#endif
