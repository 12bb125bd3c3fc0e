#ifndef NUSSELT_RELATED_HART_WARPS_GLSL
#define NUSSELT_RELATED_HART_WARPS_GLSL
// Follows include/nusselt/related/hart_warps.h @ 742765009a3b
/// Warps of uniform random numbers to polynomial densities on the unit interval and the unit square.
///
/// D. Hart, M. Pharr, T. Müller, W. Lopes, M. McGuire, P. Shirley 2020, Practical Product Sampling by Fitting and
/// Composing Warps, CGF 39(4), doi:10.1111/cgf.14060. Twin of include/nusselt/related/hart_warps.h, which describes what
/// warps have in common and where the deviations stand.

#include "../core/vec.glsl"

/// The least sum of values whose reciprocal is finite.
const float kNusseltLeastSum = 4.0 * kNusseltSmallestNormal;

/// A sample of the density that is linear between values at 0 and 1, not negative, not normalised: the root in a form
/// without cancellation. 0 where both values are 0.
float hart_sample_linear(float at_0, float at_1, float u) {
    float squares = nusselt_fma(1.0 - u, at_0 * at_0, u * (at_1 * at_1));
    float denominator = at_0 + sqrt(squares);
    return below_one(u * (at_0 + at_1) / (denominator > 0.0 ? denominator : 1.0));
}

/// A density that is linear between its values at 0 and 1.
struct HartLinearWarp {
    float at_0, at_1; ///< with mean 1
};

/// \param at_0, at_1 values of the target, not negative, not normalised.
HartLinearWarp hart_linear_warp(float at_0, float at_1) {
    float sum = at_0 + at_1;
    if (!(sum > kNusseltLeastSum)) return HartLinearWarp(1.0, 1.0);
    float scale = 2.0 / sum;
    return HartLinearWarp(scale * at_0, scale * at_1);
}

float hart_linear_warp_sample(const HartLinearWarp self, float u) {
    return hart_sample_linear(self.at_0, self.at_1, u);
}

float hart_linear_warp_density(const HartLinearWarp self, float x) {
    return nusselt_fma(1.0 - x, self.at_0, x * self.at_1);
}

float hart_linear_warp_invert(const HartLinearWarp self, float x) {
    // Both values sum up to 2.
    return below_one(x * nusselt_fma(1.0 - x, self.at_0, x));
}

/// A quadratic density with the values p, q, r of the target at 0, 1/2 and 1 as control values. With p + q + r = 3, its
/// distribution function is F(x) = x (p (1 - x)^2 + x ((p + q) (1 - x) + x)).
struct HartQuadraticWarp {
    float p, q, r; ///< with mean 1
};

/// \param p, q, r values of the target at 0, 1/2 and 1, not negative, not normalised.
HartQuadraticWarp hart_quadratic_warp(float p, float q, float r) {
    float sum = p + q + r;
    if (!(sum > kNusseltLeastSum)) return HartQuadraticWarp(1.0, 1.0, 1.0);
    float scale = 3.0 / sum;
    return HartQuadraticWarp(scale * p, scale * q, scale * r);
}

float hart_quadratic_warp_density(const HartQuadraticWarp self, float x) {
    float w = 1.0 - x;
    return nusselt_fma(w, nusselt_fma(self.p, w, 2.0 * self.q * x), self.r * x * x);
}

/// \param w 1 - x.
float hart_quadratic_warp_distribution(const HartQuadraticWarp self, float x, float w) {
    return x * nusselt_fma(self.p * w, w, x * nusselt_fma(self.p + self.q, w, x));
}

/// Solves F(x) = u for x in [0, 1/2].
float hart_quadratic_warp_invert_half(const HartQuadraticWarp self, float u) {
    // F(x) = p x + (q - p) x^2 + (1 - q) x^3. Combine the root for the terms up to the second order with that for the third
    // order as reciprocal squares. Roots of u stand for its third root.
    float discriminant = nusselt_fma(self.p, self.p, 4.0 * (self.q - self.p) * u);
    float slope = 0.5 * (self.p + sqrt(nusselt_max(discriminant, 0.0)));
    float fourth_root = sqrt(sqrt(u));
    float cubic = nusselt_max(1.0 - self.q, 0.0) * (1.4 * u) * (fourth_root * sqrt(fourth_root));
    float norm = sqrt(nusselt_fma(slope, slope, cubic));
    float x = nusselt_min(u / (norm > 0.0 ? norm : 1.0), 0.5);

    // Halley's method: it finds roots of powers without their slope vanishing first.
    NUSSELT_UNROLL for (int i = 0; i < 2; ++i) {
        float w = 1.0 - x;
        float error = hart_quadratic_warp_distribution(self, x, w) - u;
        float slope_x = hart_quadratic_warp_density(self, x);
        float half_curvature = nusselt_fma(self.q - self.p, w, (self.r - self.q) * x);
        float denominator = nusselt_fma(slope_x, slope_x, -error * half_curvature);
        float step_x = error * slope_x / (denominator > 0.0 ? denominator : 1.0);
        x = nusselt_min(nusselt_max(x - step_x, 0.0), 0.5);
    }
    return x;
}

float hart_quadratic_warp_sample(const HartQuadraticWarp self, float u) {
    // Search in the half [0, 1/2] of the density or of its mirror image.
    float at_half = (1.0 / 24.0) * nusselt_fma(7.0, self.p, nusselt_fma(4.0, self.q, self.r));
    bool mirrored = u > at_half;
    HartQuadraticWarp searched = self;
    if (mirrored) searched = HartQuadraticWarp(self.r, self.q, self.p);
    float x = hart_quadratic_warp_invert_half(searched, mirrored ? 1.0 - u : u);
    return below_one(mirrored ? 1.0 - x : x);
}

float hart_quadratic_warp_invert(const HartQuadraticWarp self, float x) {
    return below_one(hart_quadratic_warp_distribution(self, x, 1.0 - x));
}

/// Values of a target in the corners of the unit square of a fan.
struct FanCorners {
    float apex;          ///< on the whole edge y = 0
    float first, last; ///< at (0, 1) and at (1, 1)
};

/// A bilinear density on the unit square of a fan.
struct HartBilinearWarp {
    HartLinearWarp marginal;
    float apex, first, last; ///< with mean 1
};

/// \param value of the target, not negative, not normalised.
HartBilinearWarp hart_bilinear_warp(const FanCorners value) {
    HartLinearWarp marginal = hart_linear_warp(2.0 * value.apex, value.first + value.last);
    float sum = 2.0 * value.apex + (value.first + value.last);
    if (!(sum > kNusseltLeastSum)) return HartBilinearWarp(marginal, 1.0, 1.0, 1.0);
    float scale = 4.0 / sum;
    return HartBilinearWarp(marginal, scale * value.apex, scale * value.first, scale * value.last);
}

/// Values at both ends of a row of the square.
vec2 hart_bilinear_warp_row(const HartBilinearWarp self, float y) {
    return vec2(nusselt_fma(1.0 - y, self.apex, y * self.first), nusselt_fma(1.0 - y, self.apex, y * self.last));
}

vec2 hart_bilinear_warp_sample(const HartBilinearWarp self, vec2 u) {
    float y = hart_linear_warp_sample(self.marginal, u.y);
    vec2 row = hart_bilinear_warp_row(self, y);
    return vec2(hart_sample_linear(row.x, row.y, u.x), y);
}

float hart_bilinear_warp_density(const HartBilinearWarp self, vec2 x) {
    vec2 row = hart_bilinear_warp_row(self, x.y);
    return nusselt_fma(1.0 - x.x, row.x, x.x * row.y);
}

vec2 hart_bilinear_warp_invert(const HartBilinearWarp self, vec2 x) {
    vec2 row = hart_bilinear_warp_row(self, x.y);
    return vec2(hart_linear_warp_invert(hart_linear_warp(row.x, row.y), x.x),
                hart_linear_warp_invert(self.marginal, x.y));
}

/// A biquadratic density on the unit square of a fan: quadratic in x for each y, and the reverse.
struct HartBiquadraticWarp {
    HartQuadraticWarp marginal;
    float apex;
    vec3 middle, end; ///< with mean 1, as the apex
};

/// \param apex   value of the target on the edge y = 0.
/// \param middle values at x = 0, 1/2, 1 and y = 1/2.
/// \param end    values at x = 0, 1/2, 1 and y = 1. All are not negative and not normalised.
HartBiquadraticWarp hart_biquadratic_warp(float apex, vec3 middle, vec3 end) {
    float sum_of_middle = middle.x + middle.y + middle.z;
    float sum_of_end = end.x + end.y + end.z;
    HartQuadraticWarp marginal = hart_quadratic_warp(3.0 * apex, sum_of_middle, sum_of_end);
    float sum = 3.0 * apex + (sum_of_middle + sum_of_end);
    if (!(sum > kNusseltLeastSum)) return HartBiquadraticWarp(marginal, 1.0, vec3(1.0), vec3(1.0));
    float scale = 9.0 / sum;
    return HartBiquadraticWarp(marginal, scale * apex, scale * middle, scale * end);
}

/// The control values of a row of the square.
vec3 hart_biquadratic_warp_row(const HartBiquadraticWarp self, float y) {
    float w = 1.0 - y;
    vec3 at_apex = vec3(w * w * self.apex);
    return nusselt_fma(y * y, self.end, nusselt_fma(2.0 * w * y, self.middle, at_apex));
}

vec2 hart_biquadratic_warp_sample(const HartBiquadraticWarp self, vec2 u) {
    float y = hart_quadratic_warp_sample(self.marginal, u.y);
    vec3 row = hart_biquadratic_warp_row(self, y);
    return vec2(hart_quadratic_warp_sample(hart_quadratic_warp(row.x, row.y, row.z), u.x), y);
}

float hart_biquadratic_warp_density(const HartBiquadraticWarp self, vec2 x) {
    vec3 row = hart_biquadratic_warp_row(self, x.y);
    return hart_quadratic_warp_density(HartQuadraticWarp(row.x, row.y, row.z), x.x);
}

vec2 hart_biquadratic_warp_invert(const HartBiquadraticWarp self, vec2 x) {
    vec3 row = hart_biquadratic_warp_row(self, x.y);
    return vec2(hart_quadratic_warp_invert(hart_quadratic_warp(row.x, row.y, row.z), x.x),
                hart_quadratic_warp_invert(self.marginal, x.y));
}

#endif
