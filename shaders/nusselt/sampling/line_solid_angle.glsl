#ifndef NUSSELT_SAMPLING_LINE_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_LINE_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/line_solid_angle.h @ 583db3f7c1fd
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
    LineExtent extent; ///< scaled to an extent of order one
    float lowest;      ///< bound on z of directions: 0 above the horizon, else the lowest number
    float inverse_scale;
    float measure;
    float pdf;
};

/// \param scale by which the extent is larger than the light.
LineSolidAngle line_solid_angle_prepare_extent(float scale, LineExtent extent) {
    LineSolidAngle self;
    self.extent = extent;
    self.lowest = -kNusseltLargest;
    self.inverse_scale = reciprocal_power_of_two(scale);
    // Eq. 1 in the limit of a radius of 0.
    float angle = 2.0 * extent.sine_extent;
    float measure = angle / extent.distance * scale;
    float density = extent.distance / (extent.visible ? angle : 1.0) * self.inverse_scale;
    bool lit = extent.visible && measure > 0.0 && is_finite(measure) && density > 0.0 && is_finite(density);
    self.measure = lit ? measure : 0.0;
    self.pdf = lit ? density : 0.0;
    return self;
}

/// \param light relative to the shading point [m]. Nothing is clipped.
LineSolidAngle line_solid_angle_prepare(LineSegment light) {
    float scale = scale_of(light);
    return line_solid_angle_prepare_extent(scale, make_line_extent(scaled(light, scale)));
}

/// Prepares the part of a light above the horizon: wi.z is never negative.
/// \param light in shading space [m].
LineSolidAngle line_clipped_solid_angle_prepare(LineSegment light) {
    float scale = scale_of(light);
    LineSolidAngle self = line_solid_angle_prepare_extent(scale, clipped_extent(scaled(light, scale)));
    self.lowest = 0.0;
    return self;
}

/// Solid angle per radius, in the limit of a thin cylinder [sr/m].
float line_solid_angle_measure(LineSolidAngle self) { return self.measure; }

/// Constant on the light; the caller knows that wi hits it.
float line_solid_angle_pdf(LineSolidAngle self, vec3 wi) { return self.pdf; }

/// \param u in [0, 1); increasing u moves from the start of the light to its end.
LightSample line_solid_angle_sample(LineSolidAngle self, float u) {
    LinePoint point = line_extent_point_at(self.extent, u * self.extent.sine_extent);
    vec3 p = line_extent_position(self.extent, point);
    vec3 wi = line_extent_direction(self.extent, point, p);
    // Next to the horizon, rounding turns directions below it.
    wi.z = nusselt_max(wi.z, self.lowest);
    return LightSample(wi, self.pdf, self.inverse_scale * p);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_solid_angle_invert(LineSolidAngle self, vec3 wi) {
    float part = line_extent_point_in(self.extent, wi).from_start;
    return below_one(part / (self.extent.visible ? self.extent.sine_extent : 1.0));
}

#endif
