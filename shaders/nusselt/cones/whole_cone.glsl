#ifndef NUSSELT_CONES_WHOLE_CONE_GLSL
#define NUSSELT_CONES_WHOLE_CONE_GLSL
// Follows include/nusselt/cones/whole_cone.h @ 7f93e47492fd
/// Sampling of an elliptic cone above the horizon in proportion to the cosine at the surface. Twin of
/// include/nusselt/cones/whole_cone.h, where the method is described, with two steps.

#include "../cones/cone_sweep.glsl"

/// Whether the horizon z = 0 does not cut a cone that is above it, but for rounding.
bool is_above_horizon(const EllipticCone cone) {
    vec3 height = heights_of_axes(cone);
    return height.z * cone.c >= hypotenuse(height.x * cone.a, height.y * cone.b);
}

struct WholeCone {
    vec3 e1, e2, e3;
    float alpha, beta;    ///< of the ellipse that is the projection along the axis
    vec2 disk_per_radius; ///< the disk of the cone per disk of the ellipse, both divided by the cosine
    vec2 odd;
    vec2 start;    ///< of the turn, a unit vector
    float measure; ///< projected solid angle [sr]
    float inverse_measure;
};

/// \param cone above the horizon; others give any density.
WholeCone make_whole_cone(const EllipticCone cone) {
    WholeCone self;
    self.e1 = cone.e1;
    self.e2 = cone.e2;
    self.e3 = cone.e3;
    float a1 = over_positive(1.0, hypotenuse(cone.a, cone.c));
    float b1 = over_positive(1.0, hypotenuse(cone.b, cone.c));
    self.alpha = a1 * cone.a;
    self.beta = b1 * cone.b;
    self.disk_per_radius = vec2(a1 * cone.c, b1 * cone.c);
    // Rounding chooses the axes of nearly circular cones, so that the turn starts at the x-axis instead.
    float across = hypotenuse(cone.e1.x, cone.e2.x);
    self.start = across > 0.0 ? vec2(cone.e1.x, cone.e2.x) / across : vec2(1.0, 0.0);
    bool rises = cone.e3.z > 0.0;
    float inverse = 1.0 / (rises ? cone.e3.z : 1.0);
    self.odd = vec2(cone.e1.z * self.alpha * inverse, cone.e2.z * self.beta * inverse);
    float measure = kNusseltPi * (self.alpha * self.beta) * cone.e3.z;
    float inverse_measure = 1.0 / (measure > 0.0 ? measure : 1.0);
    // Fractions of the measure must not be denormal: devices may flush them to zero.
    bool lit = rises && cone.is_visible && measure > 4.0 * kNusseltSmallestNormal && is_finite(inverse_measure);
    self.measure = lit ? measure : 0.0;
    self.inverse_measure = lit ? inverse_measure : 0.0;
    return self;
}

struct WholeConeRay {
    float extent; ///< m, the largest sine of the angle from the axis
    float rim;    ///< the least cosine of it
    float eta;    ///< weight of the odd term
    float ratio;  ///< Phi(m)
};

/// The cosine of the angle from the axis at a radius in [0, 1], accurate relative to itself for wide cones, too.
float whole_cone_complement(const WholeConeRay ray, float r) {
    float at_rim = ray.rim * r;
    return sqrt(nusselt_fma(at_rim, at_rim, (1.0 - r) * (1.0 + r)));
}

/// (asin(y) - y sqrt(1 - y^2)) / y^3 for y in [0, 1].
float segment_ratio(float y, float complement) {
    // This is the cycloid for twice the angle asin(y), over the sine.
    return 0.5 * cycloid_over_cubed_sine(atan2_positive(y, complement), y, complement);
}

WholeConeRay whole_cone_ray(const WholeCone self, vec2 direction) {
    float extent = nusselt_min(hypotenuse(self.alpha * direction.x, self.beta * direction.y), 1.0);
    vec2 towards = self.disk_per_radius * direction;
    float rim = sqrt(dot(towards, towards));
    return WholeConeRay(extent, rim, nusselt_fma(self.odd.x, direction.x, self.odd.y * direction.y),
                        segment_ratio(extent, rim));
}

float whole_cone_value(const WholeConeRay ray, float zeta, float r) {
    float y = nusselt_min(ray.extent * r, 1.0);
    return r * r * nusselt_fma(zeta * r, segment_ratio(y, whole_cone_complement(ray, r)), 1.0);
}

/// The radius in [0, 1] for which whole_cone_value() is the goal.
float whole_cone_solve(const WholeConeRay ray, float zeta, float goal) {
    // The start is exact at both ends. Steps go to the root of Taylor's polynomial of degree two, in Blinn's form.
    float z = zeta * ray.ratio;
    float guess = nusselt_min(sqrt(goal / nusselt_max(1.0 + z, kNusseltEpsilon)), 1.0);
    float r = nusselt_min(sqrt(goal / nusselt_max(nusselt_fma(z, guess, 1.0), kNusseltEpsilon)), 1.0);
    NUSSELT_LOOP for (int i = 0; i < 2; ++i) {
        float w = nusselt_max(whole_cone_complement(ray, r), 9.31322574615478515625e-10);
        float inverse = 1.0 / w;
        float f = whole_cone_value(ray, zeta, r) - goal;
        float slope = 2.0 * r * nusselt_max(nusselt_fma(zeta * r, inverse, 1.0), 0.0);
        float curve = nusselt_fma(2.0 * zeta * r, nusselt_fma(w, w, 1.0) * (inverse * inverse * inverse), 2.0);
        float root = sqrt(nusselt_max(nusselt_fma(slope, slope, -2.0 * f * curve), 0.0));
        r = nusselt_min(nusselt_max(r - 2.0 * over_positive(f, slope + root), 0.0), 1.0);
    }
    return r;
}

/// \param u in [0, 1)^2; u.x turns around the axis, from the x-axis, u.y leads from one side of the cone to the
///          other. Continuous in both.
ConeSample whole_cone_sample(const WholeCone self, vec2 u) {
    SinCos turn = sincos_half_turn(kNusseltPi * u.x);
    vec2 direction = vec2(self.start.x * turn.cosine - self.start.y * turn.sine,
                          self.start.y * turn.cosine + self.start.x * turn.sine);
    WholeConeRay ray = whole_cone_ray(self, direction);
    float kappa = nusselt_fma(2.0, u.y, -1.0) + ray.eta * ray.ratio;
    float zeta = kappa < 0.0 ? -ray.eta : ray.eta;
    float goal = nusselt_min(abs(kappa), nusselt_fma(zeta, ray.ratio, 1.0));
    float radius = whole_cone_solve(ray, zeta, goal);
    float r = kappa < 0.0 ? -radius : radius;
    float z = whole_cone_complement(ray, radius);
    vec3 wi = (r * self.alpha * direction.x) * self.e1 + (r * self.beta * direction.y) * self.e2 + z * self.e3;
    float inverse = over_positive(r, z);
    return ConeSample(wi, self.disk_per_radius * direction * inverse);
}

/// The random numbers for which the sample is a unit direction in the cone.
vec2 whole_cone_invert(const WholeCone self, vec3 wi) {
    float e1 = dot(wi, self.e1), e2 = dot(wi, self.e2);
    vec2 end = vec2(copysign(over_positive(abs(e1), self.alpha), e1), copysign(over_positive(abs(e2), self.beta), e2));
    float len = hypotenuse(end.x, end.y);
    float inverse = over_positive(1.0, len);
    vec2 direction = inverse > 0.0 ? end * inverse : self.start;
    // The half of the turn to which the diameter belongs.
    float sine = self.start.x * direction.y - self.start.y * direction.x;
    float side = sine < 0.0 ? -1.0 : 1.0;
    WholeConeRay ray = whole_cone_ray(self, side * direction);
    float f = whole_cone_value(ray, side * ray.eta, nusselt_min(len, 1.0));
    float angle = atan2_positive(abs(sine), side * dot(self.start, direction));
    return vec2(below_one((1.0 / kNusseltPi) * angle), below_one(0.5 * (1.0 + (side * f - ray.eta * ray.ratio))));
}

#endif
