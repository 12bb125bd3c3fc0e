#ifndef NUSSELT_SAMPLING_LINE_PROJECTED_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_LINE_PROJECTED_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/line_projected_solid_angle.h @ 522a927d4104
/// Uniform sampling of the projected solid angle of a linear light: density proportional to the cosine at the surface.
/// With a Lambertian tube on a Lambertian surface, all noise that remains comes from shadows.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379. Twin of
/// include/nusselt/sampling/line_projected_solid_angle.h.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr], wi.z over
/// the measure. The emission of the light is radiance times radius, so that the radius cancels. Space: shading space;
/// the shading point is the origin, the normal +z. Clips to the horizon by itself. Edge cases: no part above the
/// horizon, no length, or origin on the infinite line: pdf = 0, measure 0.

#include "../core/light_sample.glsl"
#include "../sampling/cosine_arc.glsl"

struct LineProjectedSolidAngle {
    CosineArc arc; ///< of the part above the horizon, scaled to an extent of order one
    float inverse_scale;
    float measure;
    float inverse_measure;
};

/// \param light in shading space [m].
LineProjectedSolidAngle line_projected_solid_angle_prepare(const LineSegment light) {
    LineProjectedSolidAngle self;
    float scale = scale_of(light);
    self.inverse_scale = reciprocal_power_of_two(scale);
    self.arc = make_cosine_arc(clipped_extent(scaled(light, scale)));
    float measure = self.arc.integral / self.arc.distance * scale;
    float inverse_measure = cosine_arc_inverse_integral(self.arc) * self.arc.distance * self.inverse_scale;
    // The reciprocal of a denormal integral may overflow although the measure is in range.
    bool lit = measure > kNusseltSmallestNormal && measure < 1.0 / kNusseltSmallestNormal &&
               self.arc.integral > kNusseltSmallestNormal;
    self.measure = lit ? measure : 0.0;
    self.inverse_measure = lit ? inverse_measure : 0.0;
    return self;
}

/// Projected solid angle per radius of the part of the light above the horizon [sr/m].
float line_projected_solid_angle_measure(const LineProjectedSolidAngle self) { return self.measure; }

/// \param wi a unit direction towards the light.
float line_projected_solid_angle_pdf(const LineProjectedSolidAngle self, vec3 wi) {
    return nusselt_max(wi.z, 0.0) * self.inverse_measure;
}

/// \param u in [0, 1); increasing u moves from the start of the light to its end.
LightSample line_projected_solid_angle_sample(const LineProjectedSolidAngle self, float u) {
    LinePoint point = cosine_arc_point(self.arc, u);
    vec3 p = line_map_position(self.arc.map, point);
    vec3 wi = line_map_direction(self.arc.map, point, p);
    wi.z = nusselt_max(wi.z, 0.0);
    return LightSample(wi, line_projected_solid_angle_pdf(self, wi), self.inverse_scale * p);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_projected_solid_angle_invert(const LineProjectedSolidAngle self, vec3 wi) {
    return cosine_arc_invert(self.arc, wi);
}

#endif
