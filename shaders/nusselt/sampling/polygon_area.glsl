#ifndef NUSSELT_SAMPLING_POLYGON_AREA_GLSL
#define NUSSELT_SAMPLING_POLYGON_AREA_GLSL
// Follows include/nusselt/sampling/polygon_area.h @ c0d5b5bcf2d0
/// Uniform sampling of the area of a convex polygon. It needs no trigonometry and works for lights of any size and
/// distance, but is noisy wherever the solid angle per area varies, above all close to the light.
///
/// G. Turk 1992, Generating Random Points in Triangles, Graphics Gems I, for each triangle of a fan. Twin of
/// include/nusselt/sampling/polygon_area.h.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], |p|^2 / (area cos_light).
/// Space: any frame with the shading point as origin; no clipping, so that wi may point below the horizon.
/// Edge cases: no area, or origin in the plane of the polygon: pdf = 0.

#include "../core/light_sample.glsl"
#include "../geometry/convex_polygon.glsl"

struct PolygonArea {
    LightPlane plane;
    vec3 corner;                  ///< vertex 0
    vec3 side[kNusseltSlots - 1]; ///< from the corner to the other vertices
    float doubled_area[kNusseltSlots - 2]; ///< of the triangle between sides j and j + 1
    float doubled_total;
};

/// \param light relative to the shading point, either winding [m].
PolygonArea polygon_area_prepare(ConvexPolygon light) {
    PolygonArea self;
    self.corner = light.vertex[0];
    self.plane = LightPlane(light.normal, plane_distance(light), nusselt_length(light.vertex[0]));
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots; ++j)
        self.plane.farthest = nusselt_max(self.plane.farthest, nusselt_length(light.vertex[j]));
    self.side[0] = light.edge[0];
    self.doubled_total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        vec3 edge = light.edge[j + 1];
        self.doubled_area[j] = nusselt_max(dot(light.normal, nusselt_cross(self.side[j], edge)), 0.0);
        self.doubled_total = self.doubled_total + self.doubled_area[j];
        self.side[j + 1] = self.side[j] + edge;
    }
    return self;
}

/// Area of the light [m^2].
float polygon_area_measure(const PolygonArea self) { return 0.5 * self.doubled_total; }

/// \param distance of the point that is sampled.
float polygon_area_density(const PolygonArea self, vec3 wi, float distance) {
    float projected = polygon_area_measure(self) * abs(dot(self.plane.normal, wi));
    return self.plane.distance != 0.0 ? area_density(distance, projected) : 0.0;
}

/// \param u in [0, 1)^2; x selects the triangle of the fan around vertex 0 and the line through its first corner, y
///          the point on that line. Continuous within each triangle.
LightSample polygon_area_sample(PolygonArea self, vec2 u) {
    float target = u.x * self.doubled_total;
    vec3 a = self.side[0];
    vec3 b = self.side[1];
    float begin = 0.0;
    float chosen = self.doubled_area[0];
    float before = chosen;
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots - 2; ++j) {
        bool reached = self.doubled_area[j] > 0.0 && target >= before;
        a = reached ? self.side[j] : a;
        b = reached ? self.side[j + 1] : b;
        chosen = reached ? self.doubled_area[j] : chosen;
        begin = reached ? before : begin;
        before = before + self.doubled_area[j];
    }
    float along = nusselt_min(nusselt_max((target - begin) / (chosen > 0.0 ? chosen : 1.0), 0.0), 1.0);
    float root = sqrt(u.y);
    vec3 p = self.corner + (root * (1.0 - along)) * a + (root * along) * b;
    vec3 wi = nusselt_normalize(p);
    return LightSample(wi, polygon_area_density(self, wi, nusselt_length(p)), p);
}

/// \param wi a unit direction towards the light.
float polygon_area_pdf(const PolygonArea self, vec3 wi) {
    return polygon_area_density(self, wi, light_plane_distance_along(self.plane, wi));
}

/// The random numbers for which the sample is wi, a direction on the light; (0, 0) at vertex 0.
vec2 polygon_area_invert(PolygonArea self, vec3 wi) {
    vec3 q = light_plane_distance_along(self.plane, wi) * wi - self.corner;
    vec3 n = self.plane.normal;
    bool found = self.doubled_total <= 0.0;
    float before = 0.0;
    float area_before = 0.0;
    float height = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        // The last triangle also has what rounding moved beyond it.
        if (!found && self.doubled_area[j] > 0.0) {
            float beyond_b = dot(n, nusselt_cross(q, self.side[j + 1]));
            float inverse_area = 1.0 / self.doubled_area[j];
            // Barycentric coordinates of q: of b from the triangle (a, q), of a from (q, b).
            float along_b = nusselt_max(dot(n, nusselt_cross(self.side[j], q)) * inverse_area, 0.0);
            float along_a = nusselt_max(beyond_b * inverse_area, 0.0);
            float sum = along_a + along_b;
            area_before = before + along_b / (sum > 0.0 ? sum : 1.0) * self.doubled_area[j];
            height = sum * sum;
            found = beyond_b > 0.0;
        }
        before = before + self.doubled_area[j];
    }
    return vec2(below_one(area_before / (self.doubled_total > 0.0 ? self.doubled_total : 1.0)), below_one(height));
}

#endif
