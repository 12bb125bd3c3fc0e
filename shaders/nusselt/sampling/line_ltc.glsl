#ifndef NUSSELT_SAMPLING_LINE_LTC_GLSL
#define NUSSELT_SAMPLING_LINE_LTC_GLSL
// Follows include/nusselt/sampling/line_ltc.h @ aa62462c9081
/// Sampling of a linear light proportional to a linearly transformed cosine. With a lobe that fits the specular BRDF
/// times cosine, the noise that remains comes from shadows and from the misfit.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 4.1 with Eq. 5.
/// Twin of include/nusselt/sampling/line_ltc.h, where the deviation stands.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr], that of
/// the lobe over the measure. The emission of the light is radiance times radius, so that the radius cancels. Space:
/// shading space with wo in the xz half-plane (shading_frame()); clips by itself. Edge cases: nothing of the light in
/// the lobe, no length, or origin on the infinite line up to rounding, in shading space or in cosine space: pdf = 0,
/// measure 0. Samples may lie below the surface, wi.z < 0: they count, with a contribution of zero. After
/// line_clipped_ltc_prepare() none does.

#include "../ltc/light_transform.glsl"
#include "../sampling/line_projected_solid_angle.glsl"

struct LineLtc {
    Ltc ltc;
    // The fields of a LineProjectedSolidAngle in cosine space, because WebGL forbids structures that are nested more than four
    // deep.
    CosineArc image_arc;
    float image_inverse_scale, image_measure, image_inverse_measure;
    // The part of the light that counts, in shading space and scaled to an extent of order one.
    vec3 s;              ///< from the near end to the far one
    vec3 closest;        ///< point of the infinite line
    float lowest;        ///< bound on z of points: 0 above the surface, else the lowest number
    float l0, l1;        ///< coordinates of the near and the far end along s, 0 at the closest point
    float inverse_scale; ///< a power of two
    float measure;
    float inverse_measure; ///< 0 without light
};

LineProjectedSolidAngle line_ltc_image(const LineLtc self) {
    return LineProjectedSolidAngle(self.image_arc, self.image_inverse_scale, self.image_measure, self.image_inverse_measure);
}

/// \param part  the part of the light that counts, scaled.
/// \param scale by which it is larger than the light.
LineLtc line_ltc_prepare_part(const LineSegment part, float scale, const Ltc ltc) {
    LineLtc self;
    self.lowest = -kNusseltLargest;
    self.ltc = ltc;
    LineProjectedSolidAngle image = line_projected_solid_angle_prepare(to_cosine_space(part, ltc));
    self.image_arc = image.arc;
    self.image_inverse_scale = image.inverse_scale;
    self.image_measure = image.measure;
    self.image_inverse_measure = image.inverse_measure;
    self.inverse_scale = reciprocal_power_of_two(scale);
    CenteredLine line = centered(part);
    self.s = line.inward;
    self.closest = line.closest;
    self.l0 = line.near_l;
    self.l1 = line.far_l;
    // The reciprocal of what the density of directions on the image is divided by.
    float ratio = kNusseltPi * radius_ratio(nusselt_cross(part.p0, part.s), ltc);
    float in_lobe = line_projected_solid_angle_measure(image);
    bool seen = line.len > 0.0 && in_lobe > 0.0 && ratio > 0.0;
    float measure = in_lobe / (seen ? ratio : 1.0) * scale;
    float inverse_measure = ratio / (seen ? in_lobe : 1.0) * self.inverse_scale;
    bool lit = seen && measure > 0.0 && is_finite(measure) && is_finite(inverse_measure);
    self.measure = lit ? measure : 0.0;
    self.inverse_measure = lit ? inverse_measure : 0.0;
    return self;
}

/// \param light in shading space [m].
LineLtc line_ltc_prepare(const LineSegment light, const Ltc ltc) {
    float scale = scale_of(light);
    return line_ltc_prepare_part(scaled(light, scale), scale, ltc);
}

/// Prepares the part of a light above the surface: samples are never below it.
LineLtc line_clipped_ltc_prepare(const LineSegment light, const Ltc ltc) {
    float scale = scale_of(light);
    LineLtc self = line_ltc_prepare_part(part_above_horizon(scaled(light, scale)), scale, ltc);
    self.lowest = 0.0;
    return self;
}

/// Integral of the lobe over the light per radius [1/m].
float line_ltc_measure(const LineLtc self) { return self.measure; }

/// \param wi a unit direction towards the light.
float line_ltc_pdf(const LineLtc self, vec3 wi) {
    float density = ltc_density(self.ltc, wi) * self.inverse_measure;
    return is_finite(density) ? density : 0.0;
}

/// \param u in [0, 1); increasing u moves from the start of the light to its end.
LightSample line_ltc_sample(const LineLtc self, float u) {
    // Only the coordinate along the light comes from cosine space: rounding there must not leave the light.
    vec3 image = line_projected_solid_angle_sample(line_ltc_image(self), u).p;
    float along = dot(ltc_to_shading(self.ltc, image), self.s) / self.ltc.minor;
    vec3 p = exact_fma(nusselt_min(nusselt_max(along, self.l0), self.l1), self.s, self.closest);
    p.z = nusselt_max(p.z, self.lowest);
    vec3 wi = inverse_length(p) * p;
    return LightSample(wi, line_ltc_pdf(self, wi), self.inverse_scale * p);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_ltc_invert(const LineLtc self, vec3 wi) {
    return line_projected_solid_angle_invert(line_ltc_image(self), nusselt_normalize(ltc_to_cosine(self.ltc, wi)));
}

#endif
