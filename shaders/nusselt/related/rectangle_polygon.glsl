#ifndef NUSSELT_RELATED_RECTANGLE_POLYGON_GLSL
#define NUSSELT_RELATED_RECTANGLE_POLYGON_GLSL
// Follows include/nusselt/related/rectangle_polygon.h @ 6d2fc3990e5e
/// Rectangles that stand in for other lights. Twin of include/nusselt/related/rectangle_polygon.h.

#include "../geometry/convex_polygon.glsl"

/// The rectangle with a corner and two edges that start there. To clip it, NUSSELT_MAX_VERTICES must be 4 at least.
/// \param first, second perpendicular [m].
/// \param normal        unit, in the direction of cross(first, second).
ConvexPolygon rectangle_polygon(vec3 corner, vec3 first, vec3 second, vec3 normal) {
    ConvexPolygon polygon;
    polygon.vertex[0] = corner;
    polygon.vertex[1] = corner + first;
    polygon.vertex[2] = polygon.vertex[1] + second;
    polygon.edge[0] = first;
    polygon.edge[1] = second;
    polygon.edge[2] = -first;
    NUSSELT_UNROLL for (int j = 3; j < kNusseltSlots; ++j) {
        polygon.vertex[j] = corner + second;
        polygon.edge[j] = vec3(0.0);
    }
    polygon.edge[kNusseltSlots - 1] = -second;
    polygon.normal = normal;
    return polygon;
}

#endif
