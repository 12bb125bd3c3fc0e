#ifndef NUSSELT_SAMPLING_LINE_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_LINE_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/line_solid_angle.h @ 1f293b4b56e6
/// Uniform sampling of the solid angle of a linear light, for surfaces and for volumes.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.1, Eq. 1. Twin
/// of include/nusselt/sampling/line_solid_angle.h, where the deviations stand.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr], the
/// constant 1 / measure. The emission of the light is radiance times radius, so that the radius cancels. Space: any
/// frame with the shading point as origin; line_clipped_solid_angle_prepare() wants shading space. Edge cases: no
/// length, or origin on the infinite line: pdf = 0, measure 0.

#include "../core/light_sample.glsl"
#include "../geometry/clip_line.glsl"

struct LineSolidAngle {
    LineMap map;              ///< scaled to an extent of order one
    float sign_of_s, offset; ///< of the map from random numbers, which count from the start, to shares from the near end
    float lowest;             ///< bound on z of directions: 0 above the horizon, else the lowest number
    float inverse_scale;
    float measure;
    float pdf;
};

/// \param scale by which the extent is larger than the light.
LineSolidAngle line_solid_angle_prepare_extent(float scale, const LineExtent extent) {
    LineSolidAngle self;
    self.map = make_line_map(extent);
    self.sign_of_s = extent.line.sign_of_s;
    self.offset = nusselt_fma(-0.5, self.sign_of_s, 0.5);
    self.lowest = -kNusseltLargest;
    self.inverse_scale = reciprocal_power_of_two(scale);
    // Eq. 1 in the limit of a radius of 0.
    float measure = 2.0 * extent.distance * line_extent_sine_extent(extent).density * scale;
    SineRatio ratio = line_extent_sine_ratio(extent);
    float density = 0.5 * ratio.denominator / (extent.distance * ratio.numerator) * self.inverse_scale;
    // The density of a line of denormal length may overflow although the measure is in range.
    bool lit =
        measure > kNusseltSmallestNormal && measure < 1.0 / kNusseltSmallestNormal && is_finite(density);
    self.measure = lit ? measure : 0.0;
    self.pdf = lit ? density : 0.0;
    return self;
}

/// \param light relative to the shading point [m]. Nothing is clipped.
LineSolidAngle line_solid_angle_prepare(const LineSegment light) {
    float scale = scale_of(light);
    return line_solid_angle_prepare_extent(scale, whole_extent(scaled(light, scale)));
}

/// Prepares the part of a light above the horizon: wi.z is never negative.
/// \param light in shading space [m].
LineSolidAngle line_clipped_solid_angle_prepare(const LineSegment light) {
    float scale = scale_of(light);
    LineSolidAngle self = line_solid_angle_prepare_extent(scale, clipped_extent(scaled(light, scale)));
    self.lowest = 0.0;
    return self;
}

/// Solid angle per radius, in the limit of a thin cylinder [sr/m].
float line_solid_angle_measure(const LineSolidAngle self) { return self.measure; }

/// Constant on the light; the caller knows that wi hits it.
float line_solid_angle_pdf(const LineSolidAngle self, vec3 wi) { return self.pdf; }

/// \param u in [0, 1); increasing u moves from the start of the light to its end.
LightSample line_solid_angle_sample(const LineSolidAngle self, float u) {
    LinePoint point = line_map_point_at(self.map, nusselt_fma(u, self.sign_of_s, self.offset));
    vec3 p = line_map_position(self.map, point);
    vec3 wi = line_map_direction(self.map, point, p);
    // Next to the horizon, rounding turns directions below it.
    wi.z = nusselt_max(wi.z, self.lowest);
    return LightSample(wi, self.pdf, self.inverse_scale * p);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_solid_angle_invert(const LineSolidAngle self, vec3 wi) {
    return below_one((line_map_share_in(self.map, wi) - self.offset) * self.sign_of_s);
}

#endif
