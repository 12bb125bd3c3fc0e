#ifndef NUSSELT_RELATED_POLYGON_SOLID_ANGLE_PETERS_GLSL
#define NUSSELT_RELATED_POLYGON_SOLID_ANGLE_PETERS_GLSL
// Follows include/nusselt/related/polygon_solid_angle_peters.h @ a94f0c4e52de
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672: Sec. 5,
/// with the determinant by a Householder reflection. Use polygon_solid_angle.glsl instead: this one takes small lights
/// from their rounded directions. Twin of include/nusselt/related/polygon_solid_angle_peters.h.
///
/// Measure and space as polygon_solid_angle.glsl.

#include "../core/light_sample.glsl"
#include "../geometry/convex_polygon.glsl"
#include "../related/peters_arithmetic.glsl"

struct PolygonSolidAnglePeters {
    vec3 plane_normal;
    float plane_distance;
    vec3 direction[NUSSELT_MAX_VERTICES]; ///< to the vertices
    vec3 g[NUSSELT_MAX_VERTICES - 2];     ///< G_0, G_1, G_2
    float solid_angle[NUSSELT_MAX_VERTICES - 2];
    float total;
};

/// det(a, b, c) of unit vectors: a reflection maps a to an axis.
float peters_determinant(vec3 a, vec3 b, vec3 c) {
    float sgn = a.x < 0.0 ? -1.0 : 1.0;
    float k = 1.0 / (1.0 + abs(a.x));
    float kb = k * (dot(a, b) + sgn * b.x);
    float kc = k * (dot(a, c) + sgn * c.x);
    return sgn * ((b.y - kb * a.y) * (c.z - kc * a.z) - (b.z - kb * a.z) * (c.y - kc * a.y));
}

/// \param light relative to the shading point, either winding [m]. It is not clipped, so the last slot is spare.
PolygonSolidAnglePeters polygon_solid_angle_peters_prepare(ConvexPolygon light) {
    PolygonSolidAnglePeters self;
    self.plane_normal = light.normal;
    self.plane_distance = dot(light.normal, light.vertex[0]);
    NUSSELT_UNROLL for (int j = 0; j < NUSSELT_MAX_VERTICES; ++j)
        self.direction[j] = (1.0 / sqrt(dot(light.vertex[j], light.vertex[j]))) * light.vertex[j];
    self.total = 0.0;
    vec3 c = self.direction[0];
    NUSSELT_UNROLL for (int j = 0; j < NUSSELT_MAX_VERTICES - 2; ++j) {
        vec3 a = self.direction[j + 1];
        vec3 b = self.direction[j + 2];
        self.g[j] = vec3(abs(peters_determinant(a, c, b)), dot(a, b) + dot(c, b), 1.0 + dot(a, c));
        self.solid_angle[j] = 2.0 * peters_atan2_positive(self.g[j].x, self.g[j].y + self.g[j].z);
        self.total = self.total + self.solid_angle[j];
    }
    return self;
}

/// Solid angle of the light [sr].
float polygon_solid_angle_peters_measure(const PolygonSolidAnglePeters self) { return self.total; }

/// Constant on the light; the caller knows that wi hits it.
float polygon_solid_angle_peters_pdf(const PolygonSolidAnglePeters self, vec3 wi) { return 1.0 / self.total; }

/// \param u in [0, 1)^2.
/// \returns the direction alone, as the paper does; polygon_solid_angle_peters_sample() adds density and point.
vec3 polygon_solid_angle_peters_direction(PolygonSolidAnglePeters self, vec2 u) {
    float part = u.x * self.total;
    vec3 a = self.direction[1];
    vec3 b = self.direction[2];
    vec3 c = self.direction[0];
    vec3 g = self.g[0];
    float solid_angle = self.solid_angle[0];
    NUSSELT_UNROLL for (int j = 1; j < NUSSELT_MAX_VERTICES - 2; ++j) {
        if (self.solid_angle[j] > 0.0 && part >= solid_angle) {
            part = part - solid_angle;
            a = self.direction[j + 1];
            b = self.direction[j + 2];
            g = self.g[j];
            solid_angle = self.solid_angle[j];
        }
    }
    SinCos half_angle = peters_sincos_half_turn(0.5 * part);
    vec3 r = (g.x * half_angle.cosine - g.y * half_angle.sine) * a + (g.z * half_angle.sine) * b;
    vec3 v = (2.0 * dot(a, r) / dot(r, r)) * r - a;
    float s2 = dot(c, v);
    float s = (1.0 - u.y) + s2 * u.y;
    float t = sqrt(nusselt_max((1.0 - s * s) / (1.0 - s2 * s2), 0.0));
    return (s - t * s2) * c + t * v;
}

/// \param u in [0, 1)^2.
LightSample polygon_solid_angle_peters_sample(const PolygonSolidAnglePeters self, vec2 u) {
    vec3 wi = polygon_solid_angle_peters_direction(self, u);
    return LightSample(wi, 1.0 / self.total, (self.plane_distance / dot(self.plane_normal, wi)) * wi);
}

#endif
