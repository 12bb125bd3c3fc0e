#pragma once
/// Narrow strips: lines with a normal, the limit of rectangles whose width tends to zero.

#include <nusselt/geometry/line_segment.h>

NUSSELT_NAMESPACE_BEGIN

/// How wide the origin sees a strip, over its width: the cosine between the normal of the strip and the direction to the
/// closest point of its infinite middle line. E. Heitz, S. Hill 2017, Linear-Light Shading with Linearly Transformed Cosines,
/// Sec. 1.6. The printed factor (Eq. 1.35) is the cosine with the normal of the plane through line and origin, which
/// vanishes where the strip faces the origin.
/// \param light  the middle line [m].
/// \param normal unit, perpendicular to the line; both sides shine.
/// \returns in [0, 1]; 0 if the line meets the origin.
template <class Real>
NUSSELT_HD inline Real strip_facing(const LineSegment<Real>& light, const Vec3<Real>& normal) noexcept {
    const Vec3<Real> to_line = cross(light.s, normalize(cross(light.p0, light.s)));
    return abs(dot(to_line, normal));
}

NUSSELT_NAMESPACE_END
