#pragma once
/// Closed forms for the area, solid angle and projected solid angle of convex polygons.

#include <nusselt/core/trig.h>
#include <nusselt/geometry/clip_polygon.h>
#include <nusselt/geometry/scaled_light.h>

NUSSELT_NAMESPACE_BEGIN

/// Area [m^2]; 0 for degenerate polygons.
template <class Real, int N>
NUSSELT_HD inline Real area(const ConvexPolygon<Real, N>& polygon) noexcept {
    return Real(0.5) * length(doubled_area_normal(polygon));
}

/// The power of two by which a polygon must be scaled to bring its farthest vertex to a distance of order
/// one. Scaling by it is exact, and directions, solid angles and projected solid angles do not change;
/// products of coordinates then stay in range.
template <class Real, int N>
NUSSELT_HD inline Real unit_extent_scale(const ConvexPolygon<Real, N>& polygon) noexcept {
    Real extent = Real(0);
    for (int j = 0; j < N; ++j) {
        const Vec3<Real>& v = polygon.vertex[j];
        extent = max(extent, max(max(abs(v.x), abs(v.y)), abs(v.z)));
    }
    return reciprocal_power_of_two(extent);
}

/// Scaled to an extent of order one. Coordinates below 2^(-3/4 of the exponent range) become 0: products with
/// them would underflow.
/// \param scale unit_extent_scale(polygon)
template <class Real, int N>
NUSSELT_HD inline ConvexPolygon<Real, N> with_unit_extent(const ConvexPolygon<Real, N>& polygon,
                                                          const Real& scale) noexcept {
    ConvexPolygon<Real, N> result;
    NUSSELT_UNROLL
    for (int j = 0; j < N; ++j) {
        result.vertex[j] = without_tiny(scale * polygon.vertex[j]);
        result.edge[j] = scale * polygon.edge[j];
    }
    result.normal = polygon.normal;
    return result;
}
/// The scaled polygon, for callers that do not need the scale.
template <class Real, int N>
NUSSELT_HD inline ConvexPolygon<Real, N> with_unit_extent(const ConvexPolygon<Real, N>& polygon) noexcept {
    return with_unit_extent(polygon, unit_extent_scale(polygon));
}

template <class Real, int N>
using ScaledPolygon = ScaledLight<ConvexPolygon<Real, N>, Real>;

/// The scaled polygon and its scale.
template <class Real, int N>
NUSSELT_HD inline ScaledPolygon<Real, N> to_unit_extent(const ConvexPolygon<Real, N>& polygon) noexcept {
    const Real scale = unit_extent_scale(polygon);
    return {with_unit_extent(polygon, scale), scale, reciprocal_power_of_two(scale)};
}

/// The polygon, scaled where the mask is set. Lanes do not depend on their neighbours.
template <class Real, int N>
NUSSELT_HD inline ScaledPolygon<Real, N>
to_unit_extent_where(const mask_t<Real>& scales, const ConvexPolygon<Real, N>& polygon) noexcept {
    ScaledPolygon<Real, N> unit = to_unit_extent(polygon);
    NUSSELT_UNROLL
    for (int j = 0; j < N; ++j) {
        unit.light.vertex[j] = select(scales, unit.light.vertex[j], polygon.vertex[j]);
        unit.light.edge[j] = select(scales, unit.light.edge[j], polygon.edge[j]);
    }
    unit.scale = select(scales, unit.scale, Real(1));
    unit.inverse_scale = select(scales, unit.inverse_scale, Real(1));
    return unit;
}

/// Solid angle [sr] seen from the origin by a polygon, clipped or not, in any frame; 0 if the origin lies in
/// its plane. Triangle fan with the formula of van Oosterom and Strackee (Peters 2021, polygonal lights, Eq.
/// 13).
template <class Real, int N>
NUSSELT_HD inline Real solid_angle(const ConvexPolygon<Real, N>& world) noexcept {
    const ConvexPolygon<Real, N> polygon = with_unit_extent(world);
    const Real distance = abs(plane_distance(polygon));
    Vec3<Real> offset = polygon.edge[0];
    Real total = Real(0);
    const Vec3<Real>& c = polygon.vertex[0];
    const Real rc = sqrt(dot(c, c));
    for (int j = 1; j < N - 1; ++j) {
        const Vec3<Real>& a = polygon.vertex[j];
        const Vec3<Real>& b = polygon.vertex[j + 1];
        const Real doubled_area = abs(dot(polygon.normal, cross(offset, polygon.edge[j])));
        const Real ra = sqrt(dot(a, a));
        const Real rb = sqrt(dot(b, b));
        // Eq. 13 times the product of the three distances. The triple product is twice the area of the
        // triangle times the distance of its plane and cancels nowhere.
        const Real cosines = rc * ra * rb + dot(a, b) * rc + dot(a, c) * rb + dot(b, c) * ra;
        // Without a triple product, the sign of the cosines means nothing.
        const Real product = distance * doubled_area;
        total = total + select(product > Real(0), Real(2) * atan2_positive(product, cosines), Real(0));
        offset = offset + polygon.edge[j];
    }
    return total;
}

/// Projected solid angle [sr] of the part of a polygon above the horizon, in shading space: Lambert's
/// formula.
template <class Real, int N>
NUSSELT_HD inline Real projected_solid_angle(const ConvexPolygon<Real, N>& polygon) noexcept {
    const ConvexPolygon<Real, N + 1> clipped = with_unit_extent(clip_to_horizon(with_unit_extent(polygon)));
    Real doubled = Real(0);
    for (int j = 0; j <= N; ++j) {
        const Vec3<Real>& v = clipped.vertex[j];
        const Vec3<Real>& w = clipped.vertex[j < N ? j + 1 : 0];
        const Vec3<Real> n = cross(v, clipped.edge[j]);
        const Real sine = sqrt(dot(n, n));
        const Real angle = atan2_positive(sine, dot(v, w));
        doubled = doubled + n.z * angle / select(sine > Real(0), sine, Real(1));
    }
    return Real(0.5) * abs(doubled);
}

NUSSELT_NAMESPACE_END
