#ifndef NUSSELT_RELATED_LINE_SOLID_ANGLE_PETERS_GLSL
#define NUSSELT_RELATED_LINE_SOLID_ANGLE_PETERS_GLSL
// Follows include/nusselt/related/line_solid_angle_peters.h @ 07e460f40857
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Sec. 3.5, Algorithm 1
/// without the lines for the normal, and Eq. 1 in the limit of a thin cylinder. Use line_solid_angle.glsl instead: this
/// one takes short and distant lights from the difference of two sines, and gives NaN where the light points at the
/// shading point. Twin of include/nusselt/related/line_solid_angle_peters.h.
///
/// Measure and space as line_solid_angle.glsl.

#include "../core/light_sample.glsl"
#include "../geometry/line_segment.glsl"

struct LineSolidAnglePeters {
    vec3 l0, s;
    float l0_s, inverse_q, start_s, extent_s;
};

/// \param light relative to the shading point [m].
LineSolidAnglePeters line_solid_angle_peters_prepare(const LineSegment light) {
    float l0_s = dot(light.p0, light.s);
    float squared_l0 = dot(light.p0, light.p0);
    float squared_q = squared_l0 - l0_s * l0_s;
    float end = l0_s + light.len;
    float start_s = l0_s / sqrt(squared_l0);
    float extent_s = end / sqrt(end * end + squared_q) - start_s;
    return LineSolidAnglePeters(light.p0, light.s, l0_s, 1.0 / sqrt(squared_q), start_s, extent_s);
}

/// Solid angle per radius [sr/m].
float line_solid_angle_peters_measure(const LineSolidAnglePeters self) { return 2.0 * self.inverse_q * self.extent_s; }

/// Constant on the light; the caller knows that wi hits it.
float line_solid_angle_peters_pdf(const LineSolidAnglePeters self, vec3 wi) {
    return 1.0 / line_solid_angle_peters_measure(self);
}

/// The direction w_s s + w_t t, given w_t over the distance of the line.
vec3 line_solid_angle_peters_along(const LineSolidAnglePeters self, float w_s, float scaled_w_t) {
    return (w_s - scaled_w_t * self.l0_s) * self.s + scaled_w_t * self.l0;
}

/// \param u in [0, 1).
/// \returns the direction alone, as the paper does; line_solid_angle_peters_sample() adds density and point.
vec3 line_solid_angle_peters_direction(const LineSolidAnglePeters self, float u) {
    float w_s = self.start_s + u * self.extent_s;
    return line_solid_angle_peters_along(self, w_s, self.inverse_q * sqrt(nusselt_max(1.0 - w_s * w_s, 0.0)));
}

/// \param u in [0, 1).
LightSample line_solid_angle_peters_sample(const LineSolidAnglePeters self, float u) {
    float w_s = self.start_s + u * self.extent_s;
    float scaled_w_t = self.inverse_q * sqrt(nusselt_max(1.0 - w_s * w_s, 0.0));
    vec3 wi = line_solid_angle_peters_along(self, w_s, scaled_w_t);
    return LightSample(wi, 1.0 / line_solid_angle_peters_measure(self), (1.0 / scaled_w_t) * wi);
}

#endif
