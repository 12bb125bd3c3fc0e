#pragma once
/// Where the hit points of a polygon may be: its plane, and a box around it.

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

/// The plane of a polygon with coordinates of order one and a box around it: where hit points may be.
template <class Real>
struct PolygonHull {
    LightPlane<Real> plane;
    Vec3<Real> low, high; ///< axis-aligned box

    /// The point in a unit direction that hits the polygon. In a direction that is almost in the plane, rounding may move it
    /// anywhere in the box.
    NUSSELT_HD Vec3<Real> point_along(const Vec3<Real>& wi) const noexcept {
        return clamped(plane.distance_along(wi) * wi);
    }

    /// Moves a point of the polygon, which rounding may have put before or behind the plane, along the normal to the plane,
    /// then into the box. For a light seen edge-on, points of the ray that are barely off the plane are far from where the
    /// ray meets it, and a point behind the plane would be in the shadow of the light itself.
    NUSSELT_HD Vec3<Real> moved_to_plane(const Vec3<Real>& p) const noexcept {
        const Real off_plane = plane.distance - dot(plane.normal, p);
        return clamped(multiply_add(off_plane, plane.normal, p));
    }

private:
    NUSSELT_HD Vec3<Real> clamped(const Vec3<Real>& p) const noexcept { return min(max(p, low), high); }
};

/// \param distance of the plane of the polygon from the origin, see plane_distance().
template <class Real, int N>
NUSSELT_HD inline PolygonHull<Real> hull_of(const ConvexPolygon<Real, N>& polygon,
                                            const Real& distance) noexcept {
    Real farthest = Real(0); // squared
    Vec3<Real> low = polygon.vertex[0];
    Vec3<Real> high = polygon.vertex[0];
    NUSSELT_UNROLL
    for (int j = 0; j < N; ++j) {
        const Vec3<Real>& v = polygon.vertex[j];
        farthest = max(farthest, dot(v, v));
        low = min(low, v);
        high = max(high, v);
    }
    return {{polygon.normal, distance, sqrt(farthest)}, low, high};
}

/// The same hull in all lanes.
template <class Real, class Single>
NUSSELT_HD inline PolygonHull<Real> broadcast(const PolygonHull<Single>& hull) noexcept {
    return {broadcast<Real>(hull.plane), broadcast<Real>(hull.low), broadcast<Real>(hull.high)};
}

NUSSELT_NAMESPACE_END
