#ifndef NUSSELT_SAMPLING_LINE_PROJECTED_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_LINE_PROJECTED_SOLID_ANGLE_GLSL
/// Uniform sampling of the projected solid angle of a linear light: density proportional to the cosine at the surface.
/// With a Lambertian tube on a Lambertian surface, all noise that remains comes from shadows.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.2 and 3.3,
/// Algorithms 1 and 2. Twin of include/nusselt/sampling/line_projected_solid_angle.h, where the deviations stand.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr], wi.z over
/// the measure. The emission of the light is radiance times radius, so that the radius cancels. Space: shading space;
/// the shading point is the origin, the normal +z. Clips to the horizon by itself. Edge cases: no part above the
/// horizon, no length, or origin on the infinite line: pdf = 0, measure 0.

#include "../core/light_sample.glsl"
#include "../geometry/clip_line.glsl"

/// Steps of the iteration, at most: most lights need one.
const int kNusseltLineIterations = 3;

/// A step of the iteration below it is the last one: its cube is rounding.
const float kNusseltSmallStep = 0.00390625; // 2^-8

struct LineProjectedSolidAngle {
    LineExtent extent; ///< of the part above the horizon, scaled to an extent of order one
    float inverse_scale;
    float sweep;         ///< angle between the end points
    float middle_height; ///< cosine of the direction to the middle by sine with the normal
    float slope;         ///< derivative by theta, at the begin, of the cosine with the normal
    float integral;      ///< E of the paper
    float measure;
    float inverse_measure;
};

/// \param light in shading space [m].
LineProjectedSolidAngle line_projected_solid_angle_prepare(LineSegment light) {
    LineProjectedSolidAngle self;
    float scale = scale_of(light);
    self.inverse_scale = reciprocal_power_of_two(scale);
    LineExtent e = clipped_extent(scaled(light, scale));
    self.extent = e;
    self.sweep = line_extent_sweep(e);
    LinePoint middle = line_extent_point_at(e, 0.5 * e.sine_extent);
    self.middle_height = nusselt_max(nusselt_fma(e.s.z, middle.sine, e.t.z * middle.cosine), 0.0);
    self.slope = e.s.z * e.c0 - e.t.z * e.s0;
    self.integral = cosine_integral(self.sweep, e.sine_extent, e.height0 + e.height1, e.t.z);
    float measure = self.integral / e.distance * scale;
    float inverse_measure = e.distance / (self.integral > 0.0 ? self.integral : 1.0) * self.inverse_scale;
    bool lit = e.visible && measure > 0.0 && is_finite(measure) && is_finite(inverse_measure);
    self.measure = lit ? measure : 0.0;
    self.inverse_measure = lit ? inverse_measure : 0.0;
    return self;
}

/// Projected solid angle per radius of the part of the light above the horizon [sr/m].
float line_projected_solid_angle_measure(LineProjectedSolidAngle self) { return self.measure; }

/// \param wi a unit direction towards the light.
float line_projected_solid_angle_pdf(LineProjectedSolidAngle self, vec3 wi) {
    return nusselt_max(wi.z, 0.0) * self.inverse_measure;
}

/// What the iteration needs at the angle theta from the begin.
struct LineRotation {
    float sine, cosine;         ///< of alpha
    float height, height_slope; ///< cosine with the normal and its derivative
    float integral;             ///< from the begin
};

/// \param half_angle sine and cosine of half the angle from the begin.
float line_sine_from_begin(LineExtent self, SinCos half_angle) {
    float middle = nusselt_fma(self.c0, half_angle.cosine, -self.s0 * half_angle.sine);
    return 2.0 * half_angle.sine * nusselt_max(middle, 0.0);
}

LineRotation line_rotation_to(LineExtent self, float slope, float theta) {
    SinCos half_angle = sincos_quarter_turn(0.5 * theta);
    float sine = 2.0 * half_angle.sine * half_angle.cosine;
    float cosine = nusselt_fma(-2.0 * half_angle.sine, half_angle.sine, 1.0);
    LineRotation r;
    r.sine = nusselt_fma(self.s0, cosine, self.c0 * sine);
    r.cosine = nusselt_max(nusselt_fma(self.c0, cosine, -self.s0 * sine), 0.0);
    r.height = nusselt_max(nusselt_fma(self.height0, cosine, slope * sine), 0.0);
    r.height_slope = nusselt_fma(slope, cosine, -self.height0 * sine);
    r.integral = cosine_integral(theta, line_sine_from_begin(self, half_angle), self.height0 + r.height, self.t.z);
    return r;
}

/// The angle from the begin.
float line_angle_at(LineExtent self, float sweep, float from_begin) {
    LinePoint point = line_extent_point_at(self, from_begin);
    return nusselt_min(2.0 * atan2_positive(from_begin, self.c0 + point.cosine), sweep);
}

/// Start of the iteration: by sine, the density is the cosine with the normal. It is taken as linear from the begin to
/// the middle and from there to the end.
float line_initial_sine(LineProjectedSolidAngle self, float u) {
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

/// \param u in [0, 1); increasing u moves from the begin of the light to its end.
LightSample line_projected_solid_angle_sample(LineProjectedSolidAngle self, float u) {
    float theta = line_angle_at(self.extent, self.sweep, line_initial_sine(self, u));
    for (int i = 0; i < kNusseltLineIterations; ++i) {
        LineRotation rotation = line_rotation_to(self.extent, self.slope, theta);
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
    float from_begin = line_sine_from_begin(self.extent, sincos_quarter_turn(0.5 * theta));
    LinePoint point = line_extent_point_at(self.extent, nusselt_min(from_begin, self.extent.sine_extent));
    vec3 p = line_extent_position(self.extent, point);
    vec3 wi = line_extent_direction(self.extent, point, p);
    wi.z = nusselt_max(wi.z, 0.0);
    return LightSample(wi, line_projected_solid_angle_pdf(self, wi), self.inverse_scale * p);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_projected_solid_angle_invert(LineProjectedSolidAngle self, vec3 wi) {
    LinePoint point = line_extent_point_in(self.extent, wi);
    float theta = line_angle_at(self.extent, self.sweep, point.from_begin);
    float heights = self.extent.height0 + nusselt_max(wi.z, 0.0);
    float part = cosine_integral(theta, point.from_begin, heights, self.extent.t.z);
    return below_one(part / (self.integral > 0.0 ? self.integral : 1.0));
}

#endif
