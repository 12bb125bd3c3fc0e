#ifndef NUSSELT_RELATED_LINE_PROJECTED_SOLID_ANGLE_PETERS_GLSL
#define NUSSELT_RELATED_LINE_PROJECTED_SOLID_ANGLE_PETERS_GLSL
// Follows include/nusselt/related/line_projected_solid_angle_peters.h @ b802d788b1d6
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Algorithms 1 and 2
/// with Eq. 1 to 3. Use line_projected_solid_angle.glsl instead: this one loses its precision for short and distant
/// lights, and gives NaN where the light points at the shading point or lies in the horizon. Twin of
/// include/nusselt/related/line_projected_solid_angle_peters.h.
///
/// Measure and space as line_projected_solid_angle.glsl.

#include "../core/light_sample.glsl"
#include "../core/trig.glsl"
#include "../geometry/line_segment.glsl"

struct LineProjectedSolidAnglePeters {
    vec3 l0, s;
    float l0_s, inverse_q, start_s, end_s, n_s, n_t;
    float start_integral, total;
};

float peters_clamped(float x) { return nusselt_min(nusselt_max(x, -1.0), 1.0); }

/// Arcsine of w_s.
/// \param w_t its cosine.
float peters_arcsine(float w_s, float w_t) { return copysign(atan2_positive(abs(w_s), w_t), w_s); }

/// F of Eq. 3.
float peters_line_integral(float n_s, float n_t, float w_s) {
    float w_t = sqrt(1.0 - w_s * w_s);
    return n_s * w_s * w_s + n_t * (w_t * w_s + peters_arcsine(w_s, w_t));
}

/// \param light in shading space [m].
LineProjectedSolidAnglePeters line_projected_solid_angle_peters_prepare(LineSegment light) {
    LineProjectedSolidAnglePeters self =
        LineProjectedSolidAnglePeters(light.p0, light.s, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    float length = light.len;
    float start_height = self.l0.z;
    float end_height = self.l0.z + length * self.s.z;
    if (start_height <= 0.0 && end_height <= 0.0) return self;
    if (start_height < 0.0) {
        float below = -start_height / self.s.z;
        self.l0 = self.l0 + below * self.s;
        length -= below;
    } else if (end_height < 0.0) {
        length = -start_height / self.s.z;
    }
    self.l0_s = dot(self.l0, self.s);
    float q2 = dot(self.l0, self.l0) - self.l0_s * self.l0_s;
    self.inverse_q = 1.0 / sqrt(q2);
    self.start_s = peters_clamped(self.l0_s / sqrt(dot(self.l0, self.l0)));
    self.end_s = peters_clamped((self.l0_s + length) / sqrt((self.l0_s + length) * (self.l0_s + length) + q2));
    self.n_s = self.s.z;
    self.n_t = self.inverse_q * (self.l0.z - self.n_s * self.l0_s);
    self.start_integral = peters_line_integral(self.n_s, self.n_t, self.start_s);
    self.total = peters_line_integral(self.n_s, self.n_t, self.end_s) - self.start_integral;
    return self;
}

/// Projected solid angle per radius of the part of the light above the horizon [sr/m].
float line_projected_solid_angle_peters_measure(LineProjectedSolidAnglePeters self) {
    return self.inverse_q * self.total;
}

/// \param wi a unit direction towards the light.
float line_projected_solid_angle_peters_pdf(LineProjectedSolidAnglePeters self, vec3 wi) {
    return wi.z / line_projected_solid_angle_peters_measure(self);
}

/// \param u in [0, 1).
LightSample line_projected_solid_angle_peters_sample(LineProjectedSolidAnglePeters self, float u) {
    float w_s = peters_clamped(self.start_s + u * (self.end_s - self.start_s));
    float w_t = sqrt(1.0 - w_s * w_s);
    if (u >= 1e-5 && u <= 1.0 - 1e-5) {
        float target = u * self.total + self.start_integral;
        float alpha = peters_arcsine(w_s, w_t);
        for (int i = 0; i < 2; ++i) {
            float along = self.n_s * w_s + self.n_t * w_t;
            float residual = along * w_s + self.n_t * alpha - target;
            float first = 2.0 * along * w_t;
            float second = 2.0 * (self.n_s * w_t - self.n_t * w_s) * w_t - 2.0 * along * w_s;
            // The root of smaller magnitude of second / 2 x^2 + first x + residual, or the extremum.
            float root = sqrt(nusselt_max(first * first - 2.0 * second * residual, 0.0));
            float step = -2.0 * residual / (first >= 0.0 ? first + root : first - root);
            alpha = nusselt_min(nusselt_max(alpha + step, -0.5 * kNusseltPi), 0.5 * kNusseltPi);
            SinCos w = sincos_quarter_turn(abs(alpha));
            w_s = copysign(w.sine, alpha);
            w_t = w.cosine;
        }
    }
    vec3 wi = (w_s - self.inverse_q * w_t * self.l0_s) * self.s + (self.inverse_q * w_t) * self.l0;
    float cosine = w_s * self.n_s + w_t * self.n_t;
    return LightSample(wi, cosine / line_projected_solid_angle_peters_measure(self),
                       (1.0 / (w_t * self.inverse_q)) * wi);
}

#endif
