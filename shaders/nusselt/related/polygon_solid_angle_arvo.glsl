#ifndef NUSSELT_RELATED_POLYGON_SOLID_ANGLE_ARVO_GLSL
#define NUSSELT_RELATED_POLYGON_SOLID_ANGLE_ARVO_GLSL
// Follows include/nusselt/related/polygon_solid_angle_arvo.h @ e4b266b5300e
/// A published method, to compare with: uniform sampling of the solid angle of a polygon as a fan of spherical triangles.
/// J. Arvo 1995, Stratified Sampling of Spherical Triangles, SIGGRAPH 95, doi:10.1145/218380.218500, and for polygons J. Arvo
/// 2001, Stratified Sampling of 2-Manifolds. Use polygon_solid_angle.glsl instead: this one loses small lights. Twin of
/// include/nusselt/related/polygon_solid_angle_arvo.h.
///
/// Measure and space as polygon_solid_angle.glsl.

#include "../core/light_sample.glsl"
#include "../geometry/convex_polygon.glsl"
#include "../related/spherical_triangle_arvo.glsl"

struct PolygonSolidAngleArvo {
    vec3 plane_normal;
    float plane_distance;
    SphericalTriangleArvo triangle[NUSSELT_MAX_VERTICES - 2];
    float total;
    float inverse_total; ///< the density; 0 without light
};

/// \param light relative to the shading point, either winding [m]. It is not clipped, so the last slot is spare.
PolygonSolidAngleArvo polygon_solid_angle_arvo_prepare(ConvexPolygon light) {
    PolygonSolidAngleArvo self;
    self.plane_normal = light.normal;
    self.plane_distance = dot(light.normal, light.vertex[0]);
    vec3 v[NUSSELT_MAX_VERTICES];
    NUSSELT_UNROLL for (int j = 0; j < NUSSELT_MAX_VERTICES; ++j)
        v[j] = (1.0 / sqrt(dot(light.vertex[j], light.vertex[j]))) * light.vertex[j];
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < NUSSELT_MAX_VERTICES - 2; ++j) {
        self.triangle[j] = make_spherical_triangle_arvo(v[j + 1], v[0], v[j + 2]);
        self.total = self.total + self.triangle[j].solid_angle;
    }
    self.inverse_total = self.total > 0.0 ? 1.0 / self.total : 0.0;
    return self;
}

/// Solid angle of the light [sr].
float polygon_solid_angle_arvo_measure(const PolygonSolidAngleArvo self) { return self.total; }

/// Constant on the light; the caller knows that wi hits it.
float polygon_solid_angle_arvo_pdf(const PolygonSolidAngleArvo self, vec3 wi) { return self.inverse_total; }

/// The random numbers for which polygon_solid_angle_arvo_sample() returns wi, a unit direction on the light.
vec2 polygon_solid_angle_arvo_invert(PolygonSolidAngleArvo self, vec3 wi) {
    // Seen from the shading point, a light whose normal points away has its vertices in clockwise order.
    float side = self.plane_distance < 0.0 ? 1.0 : -1.0;
    float part = 0.0;
    float along = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < NUSSELT_MAX_VERTICES - 2; ++j) {
        PlaceInTriangle place = spherical_triangle_arvo_place_of(self.triangle[j], wi, side);
        part = part + place.part;
        if (j == 0 || place.behind) along = place.u;
    }
    return vec2(below_one(part * self.inverse_total), below_one(along));
}

/// \param u in [0, 1)^2; x moves along the outline of the light, y from vertex 0 to it.
/// \returns the direction alone; polygon_solid_angle_arvo_sample() adds density and point.
vec3 polygon_solid_angle_arvo_direction(PolygonSolidAngleArvo self, vec2 u) {
    float part = u.x * self.total;
    SphericalTriangleArvo t = self.triangle[0];
    NUSSELT_UNROLL for (int j = 1; j < NUSSELT_MAX_VERTICES - 2; ++j) {
        if (self.triangle[j].solid_angle > 0.0 && part >= t.solid_angle) {
            part = part - t.solid_angle;
            t = self.triangle[j];
        }
    }
    return spherical_triangle_arvo_direction(t, part, u.y);
}

/// \param u in [0, 1)^2.
LightSample polygon_solid_angle_arvo_sample(const PolygonSolidAngleArvo self, vec2 u) {
    vec3 wi = self.inverse_total > 0.0 ? polygon_solid_angle_arvo_direction(self, u) : vec3(0.0, 0.0, 1.0);
    return LightSample(wi, self.inverse_total, (self.plane_distance / dot(self.plane_normal, wi)) * wi);
}

#endif
