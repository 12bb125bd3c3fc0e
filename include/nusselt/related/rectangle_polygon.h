#pragma once
/// Rectangles that stand in for other lights.

#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

/// The rectangle with a corner and two edges that start there.
/// \param first, second perpendicular [m].
/// \param normal        unit, in the direction of cross(first, second).
template <class Real>
NUSSELT_INLINE ConvexPolygon<Real, 4> rectangle_polygon(const Vec3<Real>& corner, const Vec3<Real>& first,
                                                        const Vec3<Real>& second,
                                                        const Vec3<Real>& normal) noexcept {
    const Vec3<Real> end = corner + first;
    return {{corner, end, end + second, corner + second}, {first, second, -first, -second}, normal};
}

NUSSELT_NAMESPACE_END
