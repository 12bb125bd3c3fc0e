#ifndef NUSSELT_RELATED_LINE_PROJECTED_SOLID_ANGLE_PETERS_GLSL
#define NUSSELT_RELATED_LINE_PROJECTED_SOLID_ANGLE_PETERS_GLSL
// Follows include/nusselt/related/line_projected_solid_angle_peters.h @ 88e15de1ee98
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379: Algorithms 1 and 2
/// with Eq. 1 to 3. Use line_projected_solid_angle.glsl instead: this one loses its precision for short and distant
/// lights, and gives NaN where the light points at the shading point or lies in the horizon. Twin of
/// include/nusselt/related/line_projected_solid_angle_peters.h.
///
/// Measure and space as line_projected_solid_angle.glsl.

#include "../core/light_sample.glsl"
#include "../geometry/line_segment.glsl"
#include "../related/peters_arithmetic.glsl"

struct LineProjectedSolidAnglePeters {
    vec3 l0, s;
    float n_s, n_t;
    float l0_s, inverse_q, start_s, extent_s;
    float start_integral, total;
};

float peters_clamped(float x) { return nusselt_min(nusselt_max(x, -1.0), 1.0); }

/// F of Eq. 3.
float peters_line_integral(float n_s, float n_t, float w_s) {
    float w_t = sqrt(1.0 - w_s * w_s);
    return n_s * w_s * w_s + n_t * (w_t * w_s + peters_arcsine(w_s, w_t));
}

/// \param light in shading space [m].
LineProjectedSolidAnglePeters line_projected_solid_angle_peters_prepare(const LineSegment light) {
    LineProjectedSolidAnglePeters self;
    self.l0 = light.p0;
    self.s = light.s;
    self.n_s = light.s.z;

    // Clip the line to the horizon.
    float length = light.len;
    float start_height = self.l0.z;
    float end_height = self.l0.z + length * self.n_s;
    if (start_height < 0.0 || end_height < 0.0) {
        float to_horizon = -start_height / self.n_s;
        if (start_height < 0.0) {
            self.l0 = self.l0 + to_horizon * self.s;
            length -= to_horizon;
        } else {
            length = to_horizon;
        }
    }

    self.l0_s = dot(self.l0, self.s);
    float squared_l0 = dot(self.l0, self.l0);
    float squared_q = squared_l0 - self.l0_s * self.l0_s;
    float end = self.l0_s + length;
    self.inverse_q = 1.0 / sqrt(squared_q);
    self.start_s = peters_clamped(self.l0_s / sqrt(squared_l0));
    float end_s = peters_clamped(end / sqrt(end * end + squared_q));
    self.extent_s = end_s - self.start_s;
    self.n_t = self.inverse_q * (self.l0.z - self.n_s * self.l0_s);
    self.start_integral = peters_line_integral(self.n_s, self.n_t, self.start_s);
    self.total = peters_line_integral(self.n_s, self.n_t, end_s) - self.start_integral;
    if (start_height <= 0.0 && end_height <= 0.0) self.total = 0.0;
    return self;
}

/// Projected solid angle per radius of the part of the light above the horizon [sr/m].
float line_projected_solid_angle_peters_measure(const LineProjectedSolidAnglePeters self) {
    return self.inverse_q * self.total;
}

/// \param wi a unit direction towards the light.
float line_projected_solid_angle_peters_pdf(const LineProjectedSolidAnglePeters self, vec3 wi) {
    return wi.z / line_projected_solid_angle_peters_measure(self);
}

/// Algorithm 2: w_s and w_t.
vec2 line_projected_solid_angle_peters_coordinates(const LineProjectedSolidAnglePeters self, float u) {
    float w_s = peters_clamped(self.start_s + u * self.extent_s);
    vec2 w = vec2(w_s, sqrt(1.0 - w_s * w_s));
    if (u >= 1e-5 && u <= 1.0 - 1e-5) {
        float target = u * self.total + self.start_integral;
        float alpha = peters_arcsine(w.x, w.y);
        for (int i = 0; i < 2; ++i) {
            float cosine = self.n_s * w.x + self.n_t * w.y;
            float residual = cosine * w.x + self.n_t * alpha - target;
            float first = 2.0 * cosine * w.y;
            float second = 2.0 * (self.n_s * w.y - self.n_t * w.x) * w.y - 2.0 * cosine * w.x;
            // The root of smaller magnitude of second / 2 x^2 + first x + residual, or the extremum.
            float root = sqrt(nusselt_max(first * first - 2.0 * second * residual, 0.0));
            float step = -2.0 * residual / (first + copysign(root, first));
            alpha = nusselt_min(nusselt_max(alpha + step, -0.5 * kNusseltPi), 0.5 * kNusseltPi);
            SinCos turned = peters_sincos_around_zero(alpha);
            w = vec2(turned.sine, turned.cosine);
        }
    }
    return w;
}

/// The direction w_s s + w_t t, given w_t over the distance of the line.
vec3 line_projected_solid_angle_peters_along(const LineProjectedSolidAnglePeters self, float w_s, float scaled_w_t) {
    return (w_s - scaled_w_t * self.l0_s) * self.s + scaled_w_t * self.l0;
}

/// \param u in [0, 1).
/// \returns the direction alone, as the paper does; line_projected_solid_angle_peters_sample() adds density and point.
vec3 line_projected_solid_angle_peters_direction(const LineProjectedSolidAnglePeters self, float u) {
    vec2 w = line_projected_solid_angle_peters_coordinates(self, u);
    return line_projected_solid_angle_peters_along(self, w.x, self.inverse_q * w.y);
}

/// \param u in [0, 1).
LightSample line_projected_solid_angle_peters_sample(const LineProjectedSolidAnglePeters self, float u) {
    vec2 w = line_projected_solid_angle_peters_coordinates(self, u);
    float scaled_w_t = self.inverse_q * w.y;
    vec3 wi = line_projected_solid_angle_peters_along(self, w.x, scaled_w_t);
    float cosine = w.x * self.n_s + w.y * self.n_t;
    return LightSample(wi, cosine / line_projected_solid_angle_peters_measure(self), (1.0 / scaled_w_t) * wi);
}

#endif
