#ifndef NUSSELT_GEOMETRY_POLYGON_PART_GLSL
#define NUSSELT_GEOMETRY_POLYGON_PART_GLSL
// Follows include/nusselt/geometry/polygon_part.h @ 033db878fecb
/// The part of a polygon that a technique counts, with coordinates of order one. Twin of
/// include/nusselt/geometry/polygon_part.h.

#include "../geometry/clip_polygon.glsl"
#include "../geometry/polygon_measures.glsl"

/// The plane is that of the whole light: the rounding of new vertices would tell nothing about a plane that is next to the
/// origin.
struct PolygonPart {
    ConvexPolygon polygon;
    float inverse_scale;  ///< a power of two: the part is polygon times this
    float plane_distance; ///< of polygon from the origin, with the sign of plane_distance()
};

/// All of a polygon, in any frame.
PolygonPart whole_part(const ConvexPolygon light) {
    ConvexPolygon unit = with_unit_extent(light);
    return PolygonPart(unit, reciprocal_power_of_two(unit_extent_scale(light)), plane_distance(unit));
}

/// The part of a polygon above the horizon.
/// \param light in shading space, of at most NUSSELT_MAX_VERTICES - 1 vertices if it is clipped once more.
PolygonPart part_above_horizon(const ConvexPolygon light) {
    PolygonPart whole = whole_part(light);
    // Once more to an extent of order one, since little may be left of the light.
    ConvexPolygon clipped = clip_to_horizon(whole.polygon);
    float scale = unit_extent_scale(clipped);
    return PolygonPart(with_unit_extent(clipped), whole.inverse_scale * reciprocal_power_of_two(scale),
                       scale * whole.plane_distance);
}

#endif
