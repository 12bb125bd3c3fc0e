#ifndef NUSSELT_SAMPLING_COSINE_ARC_GLSL
#define NUSSELT_SAMPLING_COSINE_ARC_GLSL
// Follows include/nusselt/sampling/cosine_arc.h @ 5b54ee07aa66
/// Directions on an arc of a great circle with a density proportional to the cosine at the surface times the cosine of
/// the angle to the middle of the circle: the inner step of projected solid angle sampling of lines and tubes.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.2 and 3.3,
/// Algorithms 1 and 2. Twin of include/nusselt/sampling/cosine_arc.h, where the deviations stand.

#include "../geometry/clip_line.glsl"

/// Steps of the iteration, at most: most lights need one.
const int kNusseltLineIterations = 3;

/// A step of the iteration below it is the last one: its cube is rounding.
const float kNusseltSmallStep = 0.00390625; // 2^-8

/// In terms of the angle alpha of LineExtent, the density is cos(alpha) n . w(alpha) / (integral / 2).
struct CosineArc {
    LineExtent extent;   ///< above the horizon
    float sweep;         ///< angle between the end points
    float middle_height; ///< cosine of the direction to the middle by sine with the normal
    float slope;         ///< derivative by theta, at the start, of the cosine with the normal
    float integral;      ///< E of the paper: 2 int cos(alpha) n . w(alpha) d alpha
};

/// \param e above the horizon.
CosineArc make_cosine_arc(LineExtent e) {
    CosineArc self;
    self.extent = e;
    self.sweep = line_extent_sweep(e);
    LinePoint middle = line_extent_point_at(e, 0.5 * e.sine_extent);
    self.middle_height = nusselt_max(nusselt_fma(e.s.z, middle.sine, e.t.z * middle.cosine), 0.0);
    self.slope = e.s.z * e.c0 - e.t.z * e.s0;
    self.integral = cosine_integral(self.sweep, e.sine_extent, e.height0 + e.height1, e.t.z);
    return self;
}

/// The quantities that the iteration needs at the angle theta from the start.
struct ArcRotation {
    float sine, cosine;         ///< of alpha
    float height, height_slope; ///< cosine with the normal and its derivative
    float integral;             ///< from the start
};

/// \param half_angle sine and cosine of half the angle from the start.
float cosine_arc_sine_from_start(CosineArc self, SinCos half_angle) {
    float middle = nusselt_fma(self.extent.c0, half_angle.cosine, -self.extent.s0 * half_angle.sine);
    return 2.0 * half_angle.sine * nusselt_max(middle, 0.0);
}

ArcRotation cosine_arc_rotation_to(CosineArc self, float theta) {
    LineExtent e = self.extent;
    SinCos half_angle = sincos_quarter_turn(0.5 * theta);
    float sine = 2.0 * half_angle.sine * half_angle.cosine;
    float cosine = nusselt_fma(-2.0 * half_angle.sine, half_angle.sine, 1.0);
    ArcRotation r;
    r.sine = nusselt_fma(e.s0, cosine, e.c0 * sine);
    r.cosine = nusselt_max(nusselt_fma(e.c0, cosine, -e.s0 * sine), 0.0);
    r.height = nusselt_max(nusselt_fma(e.height0, cosine, self.slope * sine), 0.0);
    r.height_slope = nusselt_fma(self.slope, cosine, -e.height0 * sine);
    r.integral = cosine_integral(theta, cosine_arc_sine_from_start(self, half_angle), e.height0 + r.height, e.t.z);
    return r;
}

/// The angle from the start.
float cosine_arc_angle_at(CosineArc self, float from_start) {
    LinePoint point = line_extent_point_at(self.extent, from_start);
    return nusselt_min(2.0 * atan2_positive(from_start, self.extent.c0 + point.cosine), self.sweep);
}

/// The initial guess of the iteration: by sine, the density is the cosine with the normal. It is taken as linear from
/// the start to the middle and from there to the end.
float cosine_arc_initial_sine(CosineArc self, float u) {
    float first_half = self.extent.height0 + self.middle_height;
    float target = u * (first_half + self.middle_height + self.extent.height1);
    bool in_first = target < first_half;
    float low = in_first ? self.extent.height0 : self.middle_height;
    float rise = in_first ? self.middle_height - self.extent.height0 : self.extent.height1 - self.middle_height;
    float rest = in_first ? target : target - first_half;
    float denominator = low + sqrt(nusselt_max(nusselt_fma(rise, rest, low * low), 0.0));
    float share = rest / (denominator > 0.0 ? denominator : 1.0);
    return 0.5 * nusselt_min(in_first ? share : share + 1.0, 2.0) * self.extent.sine_extent;
}

/// \param u in [0, 1); increasing u moves from the start to the end.
LinePoint cosine_arc_point(CosineArc self, float u) {
    float theta = cosine_arc_angle_at(self, cosine_arc_initial_sine(self, u));
    for (int i = 0; i < kNusseltLineIterations; ++i) {
        ArcRotation rotation = cosine_arc_rotation_to(self, theta);
        float residual = nusselt_fma(-u, self.integral, rotation.integral);
        // Laguerre's method: the root of the quadratic Taylor polynomial, in Blinn's stable form.
        float first = rotation.cosine * rotation.height;
        float second = nusselt_fma(rotation.cosine, rotation.height_slope, -rotation.sine * rotation.height);
        float denominator = first + sqrt(nusselt_max(nusselt_fma(first, first, -second * residual), 0.0));
        float step = residual / (denominator > 0.0 ? denominator : 1.0);
        theta = nusselt_min(nusselt_max(theta - step, 0.0), self.sweep);
        // The step leaves an error of the order of its cube, relative to the scale on which the density changes.
        if (!(abs(step) * (first + abs(second)) > kNusseltSmallStep * first)) break;
    }
    float from_start = cosine_arc_sine_from_start(self, sincos_quarter_turn(0.5 * theta));
    return line_extent_point_at(self.extent, nusselt_min(from_start, self.extent.sine_extent));
}

/// The random number for which cosine_arc_point() returns the one in direction wi, a unit direction on the arc.
float cosine_arc_invert(CosineArc self, vec3 wi) {
    LinePoint point = line_extent_point_in(self.extent, wi);
    float theta = cosine_arc_angle_at(self, point.from_start);
    float heights = self.extent.height0 + nusselt_max(wi.z, 0.0);
    float part = cosine_integral(theta, point.from_start, heights, self.extent.t.z);
    return below_one(part / (self.integral > 0.0 ? self.integral : 1.0));
}

#endif
