#ifndef NUSSELT_SAMPLING_POLYGON_BRDF_GLSL
#define NUSSELT_SAMPLING_POLYGON_BRDF_GLSL
// Follows include/nusselt/sampling/polygon_brdf.h @ fa6e4dc1853a
/// BRDF sampling of a convex polygon: directions by the BRDF alone, and a test whether they hit the light. Twin of
/// include/nusselt/sampling/polygon_brdf.h.
///
/// Measure: pdf is the density of the lobe [1/sr]. Over the light it integrates to the share of samples that hit, which
/// is not known: there is no polygon_brdf_measure().
/// Space: shading space; no clipping, so that wi may point below the horizon.
/// Edge cases: no area, or origin in the plane of the polygon: pdf = 0.

#include "../bsdf/ggx_visible_normals.glsl"
#include "../core/light_sample.glsl"
#include "../geometry/polygon_measures.glsl"

struct PolygonBrdf {
    GgxVisibleNormals lobe;
    // All of this is that of the light scaled to an extent of order one.
    LightPlane plane;
    vec3 low, high;           ///< axis-aligned box
    vec3 side[kNusseltSlots]; ///< normals of the planes through the origin and the edges, towards the light
    float inverse_scale;      ///< a power of two
    bool present;             ///< whether anything of the light can be seen
};

/// \param light in shading space, either winding [m].
/// \param lobe  by ggx_visible_normals_prepare() or ggx_bounded_visible_normals_prepare().
PolygonBrdf polygon_brdf_prepare(ConvexPolygon light, GgxVisibleNormals lobe) {
    PolygonBrdf self;
    self.lobe = lobe;
    ConvexPolygon unit = with_unit_extent(light);
    self.plane = LightPlane(light.normal, plane_distance(unit), 0.0);
    self.present = self.plane.distance != 0.0;
    self.low = unit.vertex[0];
    self.high = unit.vertex[0];
    float orientation = copysign(1.0, self.plane.distance);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        self.low = nusselt_min(self.low, unit.vertex[j]);
        self.high = nusselt_max(self.high, unit.vertex[j]);
        self.plane.farthest = nusselt_max(self.plane.farthest, nusselt_length(unit.vertex[j]));
        self.side[j] = orientation * nusselt_cross(unit.vertex[j], unit.edge[j]);
    }
    self.inverse_scale = reciprocal_power_of_two(unit_extent_scale(light));
    return self;
}

bool polygon_brdf_is_towards_light(PolygonBrdf self, vec3 wi) {
    bool inside = dot(self.plane.normal, wi) * self.plane.distance > 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) inside = inside && dot(self.side[j], wi) >= 0.0;
    return inside;
}

/// \param wi a unit direction towards the light.
float polygon_brdf_pdf(PolygonBrdf self, vec3 wi) {
    return self.present ? ggx_visible_normals_pdf(self.lobe, wi) : 0.0;
}

/// \param u in [0, 1)^2, as for the lobe.
/// \returns pdf = 0 where the direction misses the light.
LightSample polygon_brdf_sample(PolygonBrdf self, vec2 u) {
    vec3 wi = ggx_visible_normals_sample(self.lobe, u);
    float density = polygon_brdf_is_towards_light(self, wi) ? polygon_brdf_pdf(self, wi) : 0.0;
    vec3 p = light_plane_distance_along(self.plane, wi) * wi;
    return LightSample(wi, density, self.inverse_scale * light_plane_moved_to(self.plane, self.low, self.high, p));
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 polygon_brdf_invert(PolygonBrdf self, vec3 wi) { return ggx_visible_normals_invert(self.lobe, wi); }

#endif
