#ifndef NUSSELT_LINE_EMISSION_VISIBLE_PART_GLSL
#define NUSSELT_LINE_EMISSION_VISIBLE_PART_GLSL
// Follows include/nusselt/line_emission/visible_part.h @ 1d370cdc7d86
/// The parts of linear lights, strips and tubes whose spread reaches a point. Twin of
/// include/nusselt/line_emission/visible_part.h.

#include "../geometry/line_segment.glsl"

/// The part of a line between two places.
LineSegment line_part_between(const LineSegment line, float from, float to) {
    float low = nusselt_min(nusselt_max(from, 0.0), line.len);
    float high = nusselt_min(nusselt_max(to, low), line.len);
    return LineSegment(low * line.s + line.p0, line.s, high - low);
}

/// More than the rounding errors of places along a line where slopes in units of the distance end.
float line_place_rounding(const LineSegment line, float slope) {
    vec3 p = abs(line.p0);
    return 8.0 * kNusseltEpsilon * (1.0 + slope) * nusselt_max(nusselt_max(p.x, p.y), nusselt_max(p.z, line.len));
}

/// How far along a line the spread of its tube reaches the origin, from the place next to the origin on.
float tube_spread_reach(const LineSegment line, float foot, float slope) {
    return slope * nusselt_length(foot * line.s + line.p0) + line_place_rounding(line, slope);
}

/// The part of a linear light whose spread reaches the origin.
/// \param slope the tangent of half of the spread; above 0.
/// \returns a segment of the length 0 if nothing reaches the origin.
LineSegment visible_part(const LineSegment line, float slope) {
    float foot = -dot(line.p0, line.s);
    float reach = tube_spread_reach(line, foot, slope);
    return line_part_between(line, foot - reach, foot + reach);
}

/// The same for the axis of a tube. If the origin is beyond an end, at least the radius remains there: the cap may shine where
/// the lateral surface does not.
LineSegment visible_part_of_tube(const LineSegment axis, float radius, float slope) {
    float foot = -dot(axis.p0, axis.s);
    float reach = tube_spread_reach(axis, foot, slope);
    float nearest = nusselt_min(nusselt_max(foot, 0.0), axis.len);
    float least = nearest == foot ? 0.0 : radius;
    return line_part_between(axis, nusselt_min(foot - reach, nearest - least), nusselt_max(foot + reach, nearest + least));
}

/// The same for the middle line of a strip, which shines to both sides. \param normal unit, perpendicular to the line.
LineSegment visible_part_of_strip(const LineSegment line, vec3 normal, float slope) {
    float foot = -dot(line.p0, line.s);
    float rounding = line_place_rounding(line, slope);
    // What directions have of the slope across the line is missing along the line.
    float whole = slope * abs(dot(line.p0, normal)) + rounding;
    float across = abs(dot(line.p0, nusselt_cross(normal, line.s)));
    float squared = (whole - across) * (whole + across);
    float reach = sqrt(nusselt_max(squared, 0.0)) + rounding;
    LineSegment part = line_part_between(line, foot - reach, foot + reach);
    if (!(squared > 0.0)) part.len = 0.0;
    return part;
}

#endif
