#ifndef NUSSELT_SAMPLING_CYLINDER_AREA_GLSL
#define NUSSELT_SAMPLING_CYLINDER_AREA_GLSL
// Follows include/nusselt/sampling/cylinder_area.h @ 2620b563e918
/// Uniform sampling of the surface of a closed cylinder, caps included. Cheap to prepare, but half of the samples or
/// more lie on the far side, and it is noisy close to the light. Twin of include/nusselt/sampling/cylinder_area.h.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: |p|^2 / (area cos_light). Space: any frame with
/// the shading point as origin; no clipping, so that wi may point below the horizon. Edge cases: points that face away
/// from the origin, no length or radius: pdf = 0.

#include "../core/light_sample.glsl"
#include "../geometry/cylinder.glsl"

struct CylinderArea {
    Cylinder light;
    Frame frame; ///< n is the direction of the axis
};

/// \param light relative to the shading point [m].
CylinderArea cylinder_area_prepare(const Cylinder light) {
    return CylinderArea(light, frame_from_normal(light.axis.s));
}

/// Area of the lateral surface and the caps [m^2], no more than the largest number.
float cylinder_area_measure(const CylinderArea self) {
    float area = 2.0 * kNusseltPi * self.light.radius * (self.light.axis.len + self.light.radius);
    return nusselt_min(area, kNusseltLargest);
}

/// \param cosine between the ray, backwards, and the normal of the light.
float cylinder_area_density(const CylinderArea self, float distance, float cosine) {
    return area_density(distance, cylinder_area_measure(self) * cosine);
}

/// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves from the middle of the cap at the start over
///          the lateral surface to the middle of the other cap.
LightSample cylinder_area_sample(const CylinderArea self, vec2 u) {
    LineSegment axis = self.light.axis;
    float radius = self.light.radius;
    // Along the profile, in units of the circumference, a cap counts half its radius.
    float on_cap = 0.5 * radius;
    float position = u.y * (axis.len + radius);
    bool on_first = position < on_cap;
    bool on_side = !on_first && position < on_cap + axis.len;
    float to_middle = nusselt_max(on_first ? position : axis.len + radius - position, 0.0);
    float share = nusselt_min(to_middle / (on_cap > 0.0 ? on_cap : 1.0), 1.0);
    float rho = on_side ? radius : radius * sqrt(share);
    float along = on_first ? 0.0 : nusselt_min(position - on_cap, axis.len);

    // The azimuth in [-pi, pi).
    float turn = kNusseltPi * nusselt_fma(2.0, u.x, -1.0);
    SinCos angle = sincos_half_turn(abs(turn));
    float sine = copysign(abs(angle.sine), turn);
    vec3 outwards = angle.cosine * self.frame.t + sine * self.frame.b;
    vec3 p = nusselt_fma(rho, outwards, exact_fma(along, axis.s, axis.p0));
    vec3 normal = on_side ? outwards : (on_first ? -axis.s : axis.s);
    vec3 wi = inverse_length(p) * p;
    return LightSample(wi, cylinder_area_density(self, nusselt_length(p), -dot(wi, normal)), p);
}

/// \param wi a unit direction towards the light.
float cylinder_area_pdf(const CylinderArea self, vec3 wi) {
    LightHit hit = intersect(self.light, wi);
    return hit.hits ? cylinder_area_density(self, hit.distance, hit.cosine) : 0.0;
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cylinder_area_invert(const CylinderArea self, vec3 wi) {
    LineSegment axis = self.light.axis;
    float radius = self.light.radius;
    float distance = intersect(self.light, wi).distance;
    vec3 from_start = distance * wi - axis.p0;
    float along = dot(from_start, axis.s);
    float x = dot(from_start, self.frame.t);
    float y = dot(from_start, self.frame.b);
    float turn = copysign(atan2_positive(abs(y), x), y);
    // At the rims, where rounding decides, both parts of the profile meet.
    float rounding = 8.0 * kNusseltEpsilon * (distance + axis.len);
    float cap = 0.5 * radius;
    float safe_radius = radius > 0.0 ? radius : 1.0;
    float on_cap = cap * nusselt_min((x * x + y * y) / (safe_radius * safe_radius), 1.0);
    float position = cap + along;
    if (along <= rounding)
        position = on_cap;
    else if (along >= axis.len - rounding)
        position = axis.len + radius - on_cap;
    float profile = axis.len + radius;
    return vec2(below_one(nusselt_fma(turn, 0.5 / kNusseltPi, 0.5)),
                below_one(position / (profile > 0.0 ? profile : 1.0)));
}

#endif
