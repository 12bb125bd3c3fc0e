#pragma once
/// The part of a polygon that a technique counts, with coordinates of order one.

#include <nusselt/geometry/clip_polygon.h>
#include <nusselt/geometry/polygon_measures.h>

NUSSELT_NAMESPACE_BEGIN

/// The plane is that of the whole light: the rounding of new vertices would tell nothing about a plane that is next to the
/// origin.
template <class Real, int N>
struct PolygonPart {
    ConvexPolygon<Real, N> polygon;
    Real inverse_scale;  ///< a power of two: the part is polygon times this
    Real plane_distance; ///< of polygon from the origin, with the sign of plane_distance()
};

/// All of a polygon, in any frame.
template <class Real, int N>
NUSSELT_HD inline PolygonPart<Real, N> whole_part(const ConvexPolygon<Real, N>& light) noexcept {
    const ScaledPolygon<Real, N> unit = to_unit_extent(light);
    return {unit.light, unit.inverse_scale, plane_distance(unit.light)};
}

/// The part of a polygon above the horizon.
/// \param light in shading space.
template <class Real, int N>
NUSSELT_HD inline PolygonPart<Real, N + 1> part_above_horizon(const ConvexPolygon<Real, N>& light) noexcept {
    const PolygonPart<Real, N> whole = whole_part(light);
    // Once more to an extent of order one, since little may be left of the light.
    const ScaledPolygon<Real, N + 1> part = to_unit_extent(clip_to_horizon(whole.polygon));
    return {part.light, whole.inverse_scale * part.inverse_scale, part.scale * whole.plane_distance};
}

NUSSELT_NAMESPACE_END
