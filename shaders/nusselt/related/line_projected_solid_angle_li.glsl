#ifndef NUSSELT_RELATED_LINE_PROJECTED_SOLID_ANGLE_LI_GLSL
#define NUSSELT_RELATED_LINE_PROJECTED_SOLID_ANGLE_LI_GLSL
// Follows include/nusselt/related/line_projected_solid_angle_li.h @ de8a9cee73bf
/// A published method, to compare with: projected solid angle sampling of a line by Newton's method within a bracket.
///
/// T.-M. Li, M. Aittala, F. Durand, J. Lehtinen 2018, Differentiable Monte Carlo Ray Tracing through Edge Sampling, ACM
/// TOG 37(6), doi:10.1145/3272127.3275109. Use line_projected_solid_angle.glsl instead. Twin of
/// include/nusselt/related/line_projected_solid_angle_li.h, where deviations and failures stand.
///
/// Measure and space as line_projected_solid_angle.glsl.

#include "../core/light_sample.glsl"
#include "../geometry/line_segment.glsl"
#include "../related/peters_arithmetic.glsl"

/// Error of the random number at which the iteration ends, and the number of steps after which it gives up.
const float kNusseltLiTolerance = 1e-5;
const int kNusseltLiSteps = 20;

struct LineProjectedSolidAngleLi {
    vec3 s, t;       ///< unit, along the line and to its closest point
    vec3 closest;    ///< point of the infinite line [m]
    float distance;  ///< of that point from the origin [m]
    float low, high; ///< coordinates of the ends above the horizon, in units of the distance
    float start_integral, total, inverse_total;
    float measure, inverse_measure;
};

/// Twice the integral of the cosine over the angle up to the coordinate x along the line, in units of the distance.
float li_integral(const LineProjectedSolidAngleLi self, float x) {
    float angle = copysign(peters_atan2_positive(abs(x), 1.0), x);
    float ratio = x / nusselt_fma(x, x, 1.0);
    return nusselt_fma(self.s.z, x * ratio, self.t.z * (ratio + angle));
}

/// Share of the measure before the coordinate x.
float li_share(const LineProjectedSolidAngleLi self, float x) {
    return (li_integral(self, x) - self.start_integral) * self.inverse_total;
}

/// Whether a positive number and its reciprocal are normal numbers.
bool li_has_reciprocal(float x) { return x > kNusseltSmallestNormal && x < 1.0 / kNusseltSmallestNormal; }

/// \param light in shading space [m].
LineProjectedSolidAngleLi line_projected_solid_angle_li_prepare(const LineSegment light) {
    LineProjectedSolidAngleLi self;
    self.s = light.s;
    // The infinite line by its point that is closest to the origin.
    float start = dot(light.p0, self.s);
    self.closest = nusselt_fma(-start, self.s, light.p0);
    float squared = dot(self.closest, self.closest);
    bool apart = li_has_reciprocal(squared);
    self.distance = sqrt(squared);
    float inverse_distance = 1.0 / (apart ? self.distance : 1.0);
    self.t = inverse_distance * self.closest;

    // Clip the line to the horizon.
    float start_height = light.p0.z;
    float end_height = nusselt_fma(light.len, self.s.z, light.p0.z);
    self.low = inverse_distance * start;
    self.high = inverse_distance * (start + light.len);
    if (start_height < 0.0 || end_height < 0.0) {
        float crossing = -self.t.z / self.s.z;
        if (start_height < 0.0) self.low = crossing;
        if (end_height < 0.0) self.high = crossing;
    }

    self.start_integral = li_integral(self, self.low);
    float total = li_integral(self, self.high) - self.start_integral;
    bool lit = apart && (start_height > 0.0 || end_height > 0.0) && li_has_reciprocal(total);
    self.low = lit ? self.low : 0.0;
    self.high = lit ? self.high : 0.0;
    self.total = lit ? total : 0.0;
    self.inverse_total = lit ? 1.0 / total : 0.0;
    self.measure = self.total * inverse_distance;
    self.inverse_measure = lit ? self.distance * self.inverse_total : 0.0;
    return self;
}

/// Projected solid angle per radius of the part of the light above the horizon [sr/m].
float line_projected_solid_angle_li_measure(const LineProjectedSolidAngleLi self) { return self.measure; }

/// \param wi a unit direction towards the light.
float line_projected_solid_angle_li_pdf(const LineProjectedSolidAngleLi self, vec3 wi) {
    return nusselt_max(wi.z, 0.0) * self.inverse_measure;
}

/// The coordinate of a sample.
float line_projected_solid_angle_li_coordinate(const LineProjectedSolidAngleLi self, float u) {
    float low = self.low;
    float high = self.high;
    float x = 0.5 * (low + high);
    if (!(self.total > 0.0)) return x;
    for (int k = 0; k < kNusseltLiSteps; ++k) {
        float error = li_share(self, x) - u;
        if (!(abs(error) >= kNusseltLiTolerance)) break;
        if (error > 0.0) high = x;
        else low = x;
        // The derivative of the integral is 2 (n_t + n_s x) / (1 + x^2)^2.
        float squares = nusselt_fma(x, x, 1.0);
        float slope = 2.0 * nusselt_fma(x, self.s.z, self.t.z);
        float newton = x - error * self.total * squares * squares / slope;
        // A step that is not a number fails this test, too.
        bool inside = newton >= low && newton <= high;
        x = inside ? newton : 0.5 * (low + high);
    }
    return x;
}

/// \param u in [0, 1); increasing u moves from the start of the light to its end, apart from jumps of up to twice the
///          tolerance where the number of steps changes.
LightSample line_projected_solid_angle_li_sample(const LineProjectedSolidAngleLi self, float u) {
    float x = line_projected_solid_angle_li_coordinate(self, u);
    vec3 wi = (1.0 / sqrt(nusselt_fma(x, x, 1.0))) * nusselt_fma(x, self.s, self.t);
    wi.z = nusselt_max(wi.z, 0.0);
    return LightSample(wi, line_projected_solid_angle_li_pdf(self, wi),
                       nusselt_fma(self.distance * x, self.s, self.closest));
}

/// The random number for which wi, a unit direction on the light, would be the exact sample.
float line_projected_solid_angle_li_invert(const LineProjectedSolidAngleLi self, vec3 wi) {
    float across = dot(wi, self.t);
    float x = dot(wi, self.s) / (across > 0.0 ? across : 1.0);
    return below_one(li_share(self, nusselt_min(nusselt_max(x, self.low), self.high)));
}

#endif
