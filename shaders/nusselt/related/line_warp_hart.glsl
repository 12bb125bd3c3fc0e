#ifndef NUSSELT_RELATED_LINE_WARP_HART_GLSL
#define NUSSELT_RELATED_LINE_WARP_HART_GLSL
// Follows include/nusselt/related/line_warp_hart.h @ ce121ccdf01b
/// A published method, to compare with: solid angle sampling of a linear light with a random number that is warped to
/// follow the cosine at the surface.
///
/// D. Hart, M. Pharr, T. Müller, W. Lopes, M. McGuire, P. Shirley 2020, Practical Product Sampling by Fitting and
/// Composing Warps, CGF 39(4), doi:10.1111/cgf.14060, with a linear or a quadratic density. Twin of
/// include/nusselt/related/line_warp_hart.h, which describes its failures. Use line_projected_solid_angle.glsl instead.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr]. Space: shading
/// space. Nothing is clipped unless the name says so. Edge cases: no length, or origin on the infinite line: pdf = 0,
/// measure 0. u = 0 where the line begins on the horizon: pdf = 0.

#include "../related/hart_warps.glsl"
#include "../sampling/line_solid_angle.glsl"

/// Cosines at the surface, or 0 below the horizon, of both ends. A point on the horizon that replaces an end has 0, too.
vec2 hart_end_cosines(const LineSegment light) {
    float begin = nusselt_normalize(light.p0).z;
    float end = nusselt_normalize(light.p0 + light.len * light.s).z;
    return vec2(nusselt_max(begin, 0.0), nusselt_max(end, 0.0));
}

/// The density of the base may be as large as any number.
LightSample hart_weighted_sample(LightSample s, float density) {
    s.pdf = nusselt_min(density * s.pdf, kNusseltLargest);
    return s;
}

/// With a linear warp.
struct LineLinearWarpHart {
    LineSolidAngle base;
    HartLinearWarp warp;
};

/// \param base of the light, clipped or not.
LineLinearWarpHart line_linear_warp_hart_prepare_base(const LineSegment light, const LineSolidAngle base) {
    vec2 ends = hart_end_cosines(light);
    return LineLinearWarpHart(base, hart_linear_warp(ends.x, ends.y));
}

/// \param light in shading space [m].
LineLinearWarpHart line_linear_warp_hart_prepare(const LineSegment light) {
    return line_linear_warp_hart_prepare_base(light, line_solid_angle_prepare(light));
}

/// Prepares the part of a light above the horizon.
/// \param light in shading space [m].
LineLinearWarpHart line_clipped_linear_warp_hart_prepare(const LineSegment light) {
    return line_linear_warp_hart_prepare_base(light, line_clipped_solid_angle_prepare(light));
}

/// \param u in [0, 1); increasing u moves from the start of the light to its end.
LightSample line_linear_warp_hart_sample(const LineLinearWarpHart self, float u) {
    float x = hart_linear_warp_sample(self.warp, u);
    return hart_weighted_sample(line_solid_angle_sample(self.base, x), hart_linear_warp_density(self.warp, x));
}

/// \param wi a unit direction on the light.
float line_linear_warp_hart_pdf(const LineLinearWarpHart self, vec3 wi) {
    float density = hart_linear_warp_density(self.warp, line_solid_angle_invert(self.base, wi));
    return nusselt_min(density * line_solid_angle_pdf(self.base, wi), kNusseltLargest);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_linear_warp_hart_invert(const LineLinearWarpHart self, vec3 wi) {
    return hart_linear_warp_invert(self.warp, line_solid_angle_invert(self.base, wi));
}

/// Solid angle per radius of the light or of its part above the horizon [sr/m].
float line_linear_warp_hart_measure(const LineLinearWarpHart self) { return line_solid_angle_measure(self.base); }

/// With a quadratic warp.
struct LineQuadraticWarpHart {
    LineSolidAngle base;
    HartQuadraticWarp warp;
};

/// \param base of the light, clipped or not.
LineQuadraticWarpHart line_quadratic_warp_hart_prepare_base(const LineSegment light, const LineSolidAngle base) {
    vec2 ends = hart_end_cosines(light);
    float middle = nusselt_max(line_solid_angle_sample(base, 0.5).wi.z, 0.0);
    return LineQuadraticWarpHart(base, hart_quadratic_warp(ends.x, middle, ends.y));
}

/// \param light in shading space [m].
LineQuadraticWarpHart line_quadratic_warp_hart_prepare(const LineSegment light) {
    return line_quadratic_warp_hart_prepare_base(light, line_solid_angle_prepare(light));
}

/// Prepares the part of a light above the horizon.
/// \param light in shading space [m].
LineQuadraticWarpHart line_clipped_quadratic_warp_hart_prepare(const LineSegment light) {
    return line_quadratic_warp_hart_prepare_base(light, line_clipped_solid_angle_prepare(light));
}

/// \param u in [0, 1); increasing u moves from the start of the light to its end.
LightSample line_quadratic_warp_hart_sample(const LineQuadraticWarpHart self, float u) {
    float x = hart_quadratic_warp_sample(self.warp, u);
    return hart_weighted_sample(line_solid_angle_sample(self.base, x), hart_quadratic_warp_density(self.warp, x));
}

/// \param wi a unit direction on the light.
float line_quadratic_warp_hart_pdf(const LineQuadraticWarpHart self, vec3 wi) {
    float density = hart_quadratic_warp_density(self.warp, line_solid_angle_invert(self.base, wi));
    return nusselt_min(density * line_solid_angle_pdf(self.base, wi), kNusseltLargest);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_quadratic_warp_hart_invert(const LineQuadraticWarpHart self, vec3 wi) {
    return hart_quadratic_warp_invert(self.warp, line_solid_angle_invert(self.base, wi));
}

/// Solid angle per radius of the light or of its part above the horizon [sr/m].
float line_quadratic_warp_hart_measure(const LineQuadraticWarpHart self) { return line_solid_angle_measure(self.base); }

#endif
