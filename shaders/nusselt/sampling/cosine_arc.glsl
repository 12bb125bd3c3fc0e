#ifndef NUSSELT_SAMPLING_COSINE_ARC_GLSL
#define NUSSELT_SAMPLING_COSINE_ARC_GLSL
// Follows include/nusselt/sampling/cosine_arc.h @ 20956852530d
/// Directions on an arc of a great circle with a density proportional to the cosine at the surface times the cosine of
/// the angle to the middle of the circle: the inner step of projected solid angle sampling of lines and tubes.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.2 and 3.3,
/// Algorithms 1 and 2. Twin of include/nusselt/sampling/cosine_arc.h, where the deviations stand.

#include "../geometry/clip_line.glsl"

/// Steps of the iteration, at most: most lights need one.
const int kNusseltLineIterations = 3;

/// In terms of the angle alpha of LineExtent, the density is cos(alpha) n . w(alpha) / (integral / 2).
struct CosineArc {
    LineMap map;                        ///< of the part above the horizon
    float distance;                     ///< of the line from the origin
    float n_t;                          ///< component of the normal along t
    float middle_cosine, middle_height; ///< of the middle by angle
    float from_near;                    ///< sine of that middle minus that of the near end
    float inverse_sine_extent;
    float integral; ///< E of the paper: 2 int cos(alpha) n . w(alpha) d alpha
    float share_scale, share_offset;
    float guess_linear, guess_square;
};

/// The reciprocal of the integral; finite if it is 0.
float cosine_arc_inverse_integral(const CosineArc self) {
    return 1.0 / nusselt_max(self.integral, kNusseltSmallestNormal);
}

/// \param e above the horizon.
CosineArc make_cosine_arc(const LineExtent e) {
    CosineArc self;
    self.map = make_line_map(e);
    self.distance = e.distance;
    self.n_t = line_extent_n_t(e);
    CosineIntegral halves = make_cosine_integral(e, self.n_t);
    self.middle_cosine = halves.middle_cosine;
    self.middle_height = halves.middle_height;
    self.from_near = halves.from_near;
    // Without light, the denominators are 0; any values will do that keep the formulas finite.
    self.inverse_sine_extent = 1.0 / nusselt_max(self.map.sine_extent, kNusseltSmallestNormal);
    self.integral = halves.near + halves.far;

    // A random number, which counts from the start, becomes a share of the integral, which counts from the middle.
    float near_share = halves.near * cosine_arc_inverse_integral(self);
    self.share_scale = e.line.sign_of_s;
    self.share_offset = nusselt_fma(-0.5, self.share_scale, 0.5) - near_share;

    // Choose the slopes of the height for which cosine_arc_first_guess() is exact at the ends, and interpolate between them.
    float near_inverse = 1.0 / nusselt_max(halves.from_near, kNusseltSmallestNormal);
    float far_inverse = 1.0 / nusselt_max(halves.to_far, kNusseltSmallestNormal);
    float near_slope =
        near_inverse * nusselt_fma(near_inverse, halves.bend, halves.near_height - halves.middle_height);
    float far_slope = far_inverse * nusselt_fma(far_inverse, halves.bend, halves.far_height - halves.middle_height);
    self.guess_linear = nusselt_fma(far_slope, halves.near, -near_slope * halves.far);
    self.guess_square = (far_slope + near_slope) * self.integral;
    return self;
}

/// The integral from the middle to a point, see CosineIntegral.
/// \param x as LinePoint.share.
float cosine_arc_integral_to(const CosineArc self, float x, float cosine, float height) {
    float sine = nusselt_fma(x, self.map.sine_extent, -self.from_near);
    float half_tangent = sine / (self.middle_cosine + cosine);
    return nusselt_fma(sine, self.middle_height + height, self.n_t * angle_minus_sine(half_tangent));
}

/// By sine, the density is the cosine with the normal. Were that linear, the sample would solve a quadratic equation. Its
/// slope is taken as a linear function of the integral instead of a constant.
/// \returns the sine relative to the middle.
float cosine_arc_first_guess(const CosineArc self, float share, float target) {
    float change = share * nusselt_fma(share, self.guess_square, self.guess_linear);
    float squared = nusselt_max(nusselt_fma(self.middle_height, self.middle_height, change), 0.0);
    return target / (self.middle_height + sqrt(squared));
}

/// \param u in [0, 1); increasing u moves from the start to the end.
LinePoint cosine_arc_point(const CosineArc self, float u) {
    float share = nusselt_fma(u, self.share_scale, self.share_offset);
    float target = share * self.integral;
    float tolerance = 1.5 * kNusseltEpsilon * self.integral;
    float guess = cosine_arc_first_guess(self, share, target) + self.from_near;
    float x = nusselt_min(nusselt_max(guess * self.inverse_sine_extent, 0.0), 1.0);
    float n_s = self.map.inward.z;
    for (int i = 0; i < kNusseltLineIterations; ++i) {
        // Laguerre's method (Algorithm 2): the root of the quadratic Taylor polynomial, in Blinn's stable form. All
        // derivatives by the sine are multiplied by the cosine.
        float sine = line_map_sine_at(self.map, x);
        float cosine = self.distance * line_map_point_at(self.map, x).inverse_distance;
        float height = nusselt_max(nusselt_fma(n_s, sine, self.n_t * cosine), 0.0);
        float residual = cosine_arc_integral_to(self, x, cosine, height) - target; // Eq. 4
        float first = cosine * height;
        float second = cosine * nusselt_fma(n_s, cosine, -self.n_t * sine);
        float root = sqrt(nusselt_max(nusselt_fma(first, first, -second * residual), 0.0));
        float step = residual / nusselt_max(first + root, kNusseltTiny);
        x = nusselt_min(nusselt_max(nusselt_fma(-step * cosine, self.inverse_sine_extent, x), 0.0), 1.0);
        // What the quadratic polynomial lacks of the integral is a third of this cube, if the cosine changes little.
        if (abs(self.n_t * step * step * step) <= tolerance && abs(4.0 * step * sine) <= cosine) break;
    }
    return line_map_point_at(self.map, x);
}

/// The random number for which cosine_arc_point() returns the one in direction wi, a unit direction on the arc.
float cosine_arc_invert(const CosineArc self, vec3 wi) {
    float x = line_map_share_in(self.map, wi);
    float cosine = self.distance * line_map_point_at(self.map, x).inverse_distance;
    float part = cosine_arc_integral_to(self, x, cosine, nusselt_max(wi.z, 0.0));
    return below_one((part * cosine_arc_inverse_integral(self) - self.share_offset) * self.share_scale);
}

#endif
