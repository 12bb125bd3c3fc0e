#ifndef NUSSELT_GEOMETRY_POLYGON_MEASURES_GLSL
#define NUSSELT_GEOMETRY_POLYGON_MEASURES_GLSL
// Follows include/nusselt/geometry/polygon_measures.h @ aec5fe04e829
/// Closed forms for the area, solid angle and projected solid angle of convex polygons. Twin of
/// include/nusselt/geometry/polygon_measures.h.

#include "../core/trig.glsl"
#include "../geometry/clip_polygon.glsl"

/// Area [m^2]; 0 for degenerate polygons.
float area(const ConvexPolygon polygon) { return 0.5 * nusselt_length(doubled_area_normal(polygon)); }

/// The power of two by which a polygon must be scaled to bring its farthest vertex to a distance of order one.
/// Directions, solid angles and projected solid angles do not change; products of coordinates then stay in range.
float unit_extent_scale(ConvexPolygon polygon) {
    float extent = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j)
        extent = nusselt_max(extent, largest_component(polygon.vertex[j]));
    return reciprocal_power_of_two(extent);
}

/// Scaled to an extent of order one. Coordinates below 2^-96 become 0: products with them would underflow.
ConvexPolygon with_unit_extent(ConvexPolygon polygon) {
    float scale = unit_extent_scale(polygon);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        polygon.vertex[j] = without_tiny(scale * polygon.vertex[j]);
        polygon.edge[j] = scale * polygon.edge[j];
    }
    return polygon;
}

/// Solid angle [sr] seen from the origin by a polygon, clipped or not, in any frame; 0 if the origin lies in its
/// plane. Triangle fan with the formula of van Oosterom and Strackee (Peters 2021, polygonal lights, Eq. 13).
float solid_angle(const ConvexPolygon world) {
    ConvexPolygon polygon = with_unit_extent(world);
    float distance = abs(plane_distance(polygon));
    vec3 offset = polygon.edge[0];
    vec3 c = polygon.vertex[0];
    float rc = sqrt(dot(c, c));
    float total = 0.0;
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots - 1; ++j) {
        vec3 a = polygon.vertex[j];
        vec3 b = polygon.vertex[j + 1];
        float doubled_area = abs(dot(polygon.normal, nusselt_cross(offset, polygon.edge[j])));
        float ra = sqrt(dot(a, a));
        float rb = sqrt(dot(b, b));
        // Eq. 13 times the product of the three distances. The triple product is twice the area of the triangle times
        // the distance of its plane and cancels nowhere.
        float cosines = rc * ra * rb + dot(a, b) * rc + dot(a, c) * rb + dot(b, c) * ra;
        // Where a repeats b, rounding of opposite directions must not count as half a turn.
        float triple = distance * doubled_area;
        if (triple > 0.0) total = total + 2.0 * atan2_positive(triple, cosines);
        offset = offset + polygon.edge[j];
    }
    return total;
}

/// Projected solid angle [sr] of the part of a light above the horizon, in shading space: Lambert's formula.
float projected_solid_angle(const ConvexPolygon polygon) {
    ConvexPolygon clipped = with_unit_extent(clip_to_horizon(with_unit_extent(polygon)));
    float doubled = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        vec3 v = clipped.vertex[j];
        vec3 w = clipped.vertex[j + 1 < kNusseltSlots ? j + 1 : 0];
        vec3 n = nusselt_cross(v, clipped.edge[j]);
        float sine = sqrt(dot(n, n));
        doubled = doubled + n.z * atan2_positive(sine, dot(v, w)) / (sine > 0.0 ? sine : 1.0);
    }
    return 0.5 * abs(doubled);
}

#endif
