#ifndef NUSSELT_RELATED_POLYGON_PROJECTED_SOLID_ANGLE_PETERS_GLSL
#define NUSSELT_RELATED_POLYGON_PROJECTED_SOLID_ANGLE_PETERS_GLSL
// Follows include/nusselt/related/polygon_projected_solid_angle_peters.h @ 6f5672ac8f03
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672: Sec. 3, with
/// the sectors of azimuth_sectors.glsl. Use polygon_projected_solid_angle.glsl instead: this one loses small lights to the
/// difference of two arctangents, and its iteration diverges at some corners on the horizon. Twin of
/// include/nusselt/related/polygon_projected_solid_angle_peters.h.
///
/// Measure and space as polygon_projected_solid_angle.glsl.

#include "../related/azimuth_sectors.glsl"

struct PolygonProjectedSolidAnglePeters {
    AzimuthSectors sectors;
};

/// Eq. 6 for the form with the matrix [[a, b], [b, c]].
vec2 peters_root(float a, float b, float c) {
    float r = sqrt(nusselt_max(b * b - a * c, 0.0));
    return b >= 0.0 ? vec2(b + r, -a) : vec2(c, r - b);
}

/// \param light in shading space, either winding [m].
PolygonProjectedSolidAnglePeters polygon_projected_solid_angle_peters_prepare(const ConvexPolygon light) {
    return PolygonProjectedSolidAnglePeters(azimuth_sectors_prepare(light));
}

/// \copydoc azimuth_sectors_measure
float polygon_projected_solid_angle_peters_measure(const PolygonProjectedSolidAnglePeters self) {
    return azimuth_sectors_measure(self.sectors);
}

/// \copydoc azimuth_sectors_pdf
float polygon_projected_solid_angle_peters_pdf(const PolygonProjectedSolidAnglePeters self, vec3 wi) {
    return azimuth_sectors_pdf(self.sectors, wi);
}

/// \copydoc azimuth_sectors_invert
vec2 polygon_projected_solid_angle_peters_invert(const PolygonProjectedSolidAnglePeters self, vec3 wi) {
    return azimuth_sectors_invert(self.sectors, wi);
}

/// Sec. 3.2.
vec2 peters_invert_central(const AzimuthSector s, float area) {
    float root = sqrt(1.0 + dot(s.outer, s.outer));
    vec2 c = peters_times(s.outer, s.s0);
    SinCos angle = peters_sincos_half_turn(2.0 * root * area);
    return (root * angle.cosine) * s.s0 + angle.sine * vec2(-c.y, c.x);
}

/// Sec. 3.4 and two steps of Sec. 3.3.
vec2 peters_invert_decentral(const AzimuthSector s, float area) {
    vec2 s0 = (1.0 / sqrt(dot(s.s0, s.s0))) * s.s0;
    vec2 s1 = (1.0 / sqrt(dot(s.s1, s.s1))) * s.s1;
    vec2 sh = s0 + s1;
    float i0 = 1.0 / sqrt(peters_form(s.inner, s0));
    float ih = 1.0 / sqrt(peters_form(s.inner, sh));
    float i1 = 1.0 / sqrt(peters_form(s.inner, s1));
    float o0 = 1.0 / sqrt(peters_form(s.outer, s0));
    float oh = 1.0 / sqrt(peters_form(s.outer, sh));
    float o1 = 1.0 / sqrt(peters_form(s.outer, s1));
    float fraction = nusselt_min(area / s.area, 1.0);
    float quad_0 = o0 * oh - i0 * ih;
    float quad_1 = o1 * oh - i1 * ih;
    float quad_area = fraction * (quad_0 + quad_1) - quad_0;
    bool first = quad_area <= 0.0;
    vec2 sk = first ? s0 : s1;
    float ik = first ? i0 : i1;
    float ok = first ? o0 : o1;
    quad_area = (first ? quad_area + quad_0 : quad_area - quad_1) * abs(peters_plain_det(sh, sk));
    vec2 ri = peters_times(s.inner, ih * sh + ik * sk);
    vec2 ro = peters_times(s.outer, oh * sh + ok * sk);
    vec2 turned = vec2(-sk.y, sk.x);
    vec2 p = (ok * oh * dot(ro, sh)) * turned;
    vec2 q = (ik * ih * dot(ri, sh)) * turned + quad_area * ri;
    vec2 w = peters_root(p.x * ri.x - q.x * ro.x, 0.5 * (p.x * ri.y + p.y * ri.x - q.x * ro.y - q.y * ro.x),
                         p.y * ri.y - q.y * ro.y);
    int iterations = fraction < 1e-5 || fraction > 1.0 - 1e-5 ? 0 : 2;
    for (int k = 0; k <= 2; ++k) {
        if (dot(w, sh) < 0.0) w = -w;
        w = (1.0 / (abs(w.x) + abs(w.y))) * w;
        if (k == iterations) break;
        float missing = 2.0 * (area - peters_area_of(s.outer, s0, w) + peters_area_of(s.inner, s0, w));
        vec2 ci = peters_times(s.inner, w);
        vec2 co = peters_times(s.outer, w);
        vec2 gap = ci - co;
        w = peters_root(-w.y * gap.x - missing * ci.x * co.x,
                        0.5 * (-w.y * gap.y + w.x * gap.x - missing * (ci.x * co.y + ci.y * co.x)),
                        w.x * gap.y - missing * ci.y * co.y);
    }
    return w;
}

/// \param u in [0, 1)^2.
/// \returns the direction alone, as the paper does; polygon_projected_solid_angle_peters_sample() adds density and point.
vec3 polygon_projected_solid_angle_peters_direction(const PolygonProjectedSolidAnglePeters self, vec2 u) {
    float area = u.x * self.sectors.total;
    AzimuthSector s = azimuth_sectors_select(self.sectors, area);
    vec2 w;
    if (self.sectors.central) w = peters_invert_central(s, area);
    else w = peters_invert_decentral(s, area);
    return azimuth_sectors_direction(self.sectors, s, w, u.y);
}

/// \param u in [0, 1)^2.
LightSample polygon_projected_solid_angle_peters_sample(const PolygonProjectedSolidAnglePeters self, vec2 u) {
    return azimuth_sectors_complete(self.sectors, polygon_projected_solid_angle_peters_direction(self, u));
}

#endif
