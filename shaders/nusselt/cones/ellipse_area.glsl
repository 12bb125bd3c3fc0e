#ifndef NUSSELT_CONES_ELLIPSE_AREA_GLSL
#define NUSSELT_CONES_ELLIPSE_AREA_GLSL
// Follows include/nusselt/cones/ellipse_area.h @ 547e9e33ec9a
/// Sampling of ellipses (disks: disk_light()) uniformly by area: for references, and to compare with. Twin of
/// include/nusselt/cones/ellipse_area.h.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], squared distance over area times cosine at the
/// light. Space: any frame with the shading point as origin; no normal is involved and nothing is clipped. Edge
/// cases: no area, or the origin in the plane of the light: pdf = 0.

#include "../cones/round_lights.glsl"
#include "../core/light_sample.glsl"
#include "../core/trig.glsl"

struct EllipseArea {
    vec3 center, u, v;    ///< scaled to an extent of order one
    vec3 normal;          ///< unit
    vec3 to_u, to_v;      ///< from points to shares of the semi-diameters
    float measure;        ///< [m^2]
    float area, distance; ///< of the light and of its plane, scaled
    float inverse_scale;
};

/// \param light relative to the shading point [m].
EllipseArea ellipse_area_prepare(const Ellipse light) {
    RoundLightView view = view_without_cone(light);
    EllipseArea self;
    self.center = view.center;
    self.u = view.u;
    self.v = view.v;
    self.inverse_scale = view.inverse_scale;
    vec3 area = nusselt_cross(self.u, self.v);
    float size = nusselt_length(area);
    self.normal = nusselt_normalize(area);
    float area_of_unit = kNusseltPi * size;
    self.measure = nusselt_min(area_of_unit * self.inverse_scale * self.inverse_scale, kNusseltLargest);
    // Areas below the smallest number are none.
    self.area = self.measure > 0.0 ? area_of_unit : 0.0;
    self.distance = dot(self.normal, self.center);
    float inverse = over_positive(1.0, size);
    self.to_u = inverse * nusselt_cross(self.v, self.normal);
    self.to_v = inverse * nusselt_cross(self.normal, self.u);
    return self;
}

/// Area of the light [m^2].
float ellipse_area_measure(const EllipseArea self) { return self.measure; }

/// \param wi a unit direction towards the light.
float ellipse_area_pdf(const EllipseArea self, vec3 wi) {
    float cosine = abs(dot(self.normal, wi));
    return area_density(over_positive(abs(self.distance), cosine), self.area * cosine);
}

/// \param u in [0, 1)^2; u.x turns around the centre, u.y leads away from it. Continuous in both.
LightSample ellipse_area_sample(const EllipseArea self, vec2 u) {
    SinCos turn = sincos_half_turn(kNusseltPi * u.x);
    float radius = sqrt(u.y);
    float x = radius * (1.0 - 2.0 * turn.sine * turn.sine);
    float y = 2.0 * radius * turn.sine * turn.cosine;
    vec3 p = self.center + (x * self.u + y * self.v);
    vec3 direction = nusselt_normalize(p);
    bool dark = dot(direction, direction) == 0.0;
    vec3 wi = dark ? vec3(0.0, 0.0, 1.0) : direction;
    float density = area_density(nusselt_length(p), self.area * abs(dot(self.normal, wi)));
    return LightSample(wi, dark || self.distance == 0.0 ? 0.0 : density, self.inverse_scale * p);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 ellipse_area_invert(const EllipseArea self, vec3 wi) {
    float distance = over_positive(abs(self.distance), abs(dot(self.normal, wi)));
    vec3 offset = distance * wi - self.center;
    float x = dot(offset, self.to_u);
    float y = dot(offset, self.to_v);
    float angle = atan2_positive(abs(y), x);
    float turn = y < 0.0 ? 2.0 * kNusseltPi - angle : angle;
    return vec2(below_one((1.0 / (2.0 * kNusseltPi)) * turn), below_one(nusselt_fma(x, x, y * y)));
}

#endif
