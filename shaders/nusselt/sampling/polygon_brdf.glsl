#ifndef NUSSELT_SAMPLING_POLYGON_BRDF_GLSL
#define NUSSELT_SAMPLING_POLYGON_BRDF_GLSL
// Follows include/nusselt/sampling/polygon_brdf.h @ 4d52dde4fbf0
/// BRDF sampling of a convex polygon: directions by the BRDF alone, and a test whether they hit the light. Twin of
/// include/nusselt/sampling/polygon_brdf.h.
///
/// Measure: pdf is the density of the lobe [1/sr]. Over the light it integrates to the share of samples that hit, which
/// is not known: there is no polygon_brdf_measure().
/// Space: shading space; no clipping, so that wi may point below the horizon.
/// Edge cases: no area, or origin in the plane of the polygon: pdf = 0.

#include "../bsdf/ggx_visible_normals.glsl"
#include "../core/light_sample.glsl"
#include "../geometry/polygon_hull.glsl"
#include "../geometry/polygon_part.glsl"

struct PolygonBrdf {
    GgxVisibleNormals lobe;
    // All of this is that of the light scaled to an extent of order one.
    PolygonHull hull;
    vec3 side[kNusseltSlots]; ///< normals of the planes through the origin and the edges, towards the light
    float inverse_scale;      ///< a power of two
    bool present;             ///< whether anything of the light can be seen
};

/// \param light in shading space, either winding [m].
/// \param lobe  by ggx_visible_normals_prepare() or ggx_bounded_visible_normals_prepare().
PolygonBrdf polygon_brdf_prepare(const ConvexPolygon light, const GgxVisibleNormals lobe) {
    PolygonBrdf self;
    self.lobe = lobe;
    PolygonPart whole = whole_part(light);
    self.hull = hull_of(whole.polygon, whole.plane_distance);
    self.inverse_scale = whole.inverse_scale;
    self.present = self.hull.distance != 0.0;
    float orientation = copysign(1.0, self.hull.distance);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j)
        self.side[j] = orientation * nusselt_cross(whole.polygon.vertex[j], whole.polygon.edge[j]);
    return self;
}

bool polygon_brdf_is_towards_light(PolygonBrdf self, vec3 wi) {
    bool inside = dot(self.hull.normal, wi) * self.hull.distance > 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) inside = inside && dot(self.side[j], wi) >= 0.0;
    return inside;
}

/// \param wi a unit direction towards the light.
float polygon_brdf_pdf(const PolygonBrdf self, vec3 wi) {
    return self.present ? ggx_visible_normals_pdf(self.lobe, wi) : 0.0;
}

/// \param u in [0, 1)^2, as for the lobe.
/// \returns pdf = 0 where the direction misses the light.
LightSample polygon_brdf_sample(const PolygonBrdf self, vec2 u) {
    vec3 wi = ggx_visible_normals_sample(self.lobe, u);
    float density = polygon_brdf_is_towards_light(self, wi) ? polygon_brdf_pdf(self, wi) : 0.0;
    vec3 p = light_plane_distance_along(polygon_hull_plane(self.hull), wi) * wi;
    return LightSample(wi, density, self.inverse_scale * polygon_hull_moved_to_plane(self.hull, p));
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 polygon_brdf_invert(const PolygonBrdf self, vec3 wi) { return ggx_visible_normals_invert(self.lobe, wi); }

#endif
