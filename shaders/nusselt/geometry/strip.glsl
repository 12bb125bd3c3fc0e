#ifndef NUSSELT_GEOMETRY_STRIP_GLSL
#define NUSSELT_GEOMETRY_STRIP_GLSL
// Follows include/nusselt/geometry/strip.h @ 4f277bcd7549
/// Narrow strips: lines with a normal, the limit of rectangles whose width tends to zero.

#include "../geometry/line_segment.glsl"

/// How wide the origin sees a strip, over its width: the cosine between the normal of the strip and the direction to the
/// closest point of its infinite middle line, in [0, 1]; 0 if the line meets the origin.
/// \param light  the middle line [m].
/// \param normal unit, perpendicular to the line; both sides shine.
float strip_facing(const LineSegment light, vec3 normal) {
    vec3 to_line = nusselt_cross(light.s, nusselt_normalize(nusselt_cross(light.p0, light.s)));
    return abs(dot(to_line, normal));
}

#endif
