#ifndef NUSSELT_GEOMETRY_POLYGON_HULL_GLSL
#define NUSSELT_GEOMETRY_POLYGON_HULL_GLSL
// Follows include/nusselt/geometry/polygon_hull.h @ 9115317fc516
/// Where the hit points of a polygon may be: its plane, and a box around it. Twin of
/// include/nusselt/geometry/polygon_hull.h.

#include "../core/light_sample.glsl"
#include "../geometry/convex_polygon.glsl"

/// The plane of a polygon with coordinates of order one and a box around it: where hit points may be.
/// It has the fields of a LightPlane because WebGL forbids structures that are nested more than four deep.
struct PolygonHull {
    vec3 normal;
    float distance, farthest; ///< of the plane
    vec3 low, high;           ///< axis-aligned box
};

LightPlane polygon_hull_plane(const PolygonHull self) { return LightPlane(self.normal, self.distance, self.farthest); }

/// \param distance of the plane of the polygon from the origin, see plane_distance().
PolygonHull hull_of(ConvexPolygon polygon, float distance) {
    float farthest = 0.0; // squared
    vec3 low = polygon.vertex[0];
    vec3 high = polygon.vertex[0];
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        vec3 v = polygon.vertex[j];
        farthest = nusselt_max(farthest, dot(v, v));
        low = nusselt_min(low, v);
        high = nusselt_max(high, v);
    }
    return PolygonHull(polygon.normal, distance, sqrt(farthest), low, high);
}

/// The point in a unit direction that hits the polygon. In a direction that is almost in the plane, rounding may move it
/// anywhere in the box.
vec3 polygon_hull_point_along(const PolygonHull self, vec3 wi) {
    return nusselt_min(nusselt_max(light_plane_distance_along(polygon_hull_plane(self), wi) * wi, self.low), self.high);
}

/// Moves a point of the polygon, which rounding may have put before or behind the plane, along the normal to the plane,
/// then into the box.
vec3 polygon_hull_moved_to_plane(const PolygonHull self, vec3 p) {
    float off_plane = self.distance - dot(self.normal, p);
    return nusselt_min(nusselt_max(p + off_plane * self.normal, self.low), self.high);
}

#endif
