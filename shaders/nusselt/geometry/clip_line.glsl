#ifndef NUSSELT_GEOMETRY_CLIP_LINE_GLSL
#define NUSSELT_GEOMETRY_CLIP_LINE_GLSL
// Follows include/nusselt/geometry/clip_line.h @ c35fc548ecae
/// Extents of line segments, whole or clipped to the upper hemisphere, and their closed forms. Twin of
/// include/nusselt/geometry/clip_line.h.

#include "../geometry/line_segment.glsl"

/// Power of two that brings the coordinates of a segment to order one, so that their squares stay in range.
float scale_of(LineSegment line) {
    return reciprocal_power_of_two(nusselt_max(largest_component(line.p0), line.len));
}

LineSegment scaled(LineSegment line, float scale) {
    return LineSegment(scale * line.p0, line.s, scale * line.len);
}

/// The end of a segment. Where it is close to the origin, rounding of the product would turn its direction.
vec3 end_of(LineSegment line) { return exact_fma(line.len, line.s, line.p0); }

/// The extent of a whole segment, in any frame.
LineExtent make_line_extent(LineSegment line) {
    // Cross products with exact signs instead of p0 - (p0 . s) s, which loses the square of the distance.
    vec3 moment = nusselt_cross(line.p0, line.s);
    vec3 end = end_of(line);
    return make_line_extent(line.s, line.p0, end, nusselt_cross(line.s, moment), sqrt(dot(moment, moment)),
                            dot(line.p0, line.s), dot(end, line.s), line.len);
}

/// The part with z > 0 of a segment between two points of its line. The parameters of the line stay; only an end point
/// moves, to z = 0 exactly. Parameters as those of make_line_extent().
LineExtent clipped_extent(vec3 s, vec3 p0, vec3 p1, vec3 closest, float distance, float start, float end,
                          float length) {
    float z0 = without_tiny(p0.z);
    float z1 = without_tiny(p1.z);
    bool rises = z0 < 0.0 && z1 > 0.0;
    bool falls = z0 > 0.0 && z1 < 0.0;
    if (rises || falls) {
        float slope = s.z;
        // The remaining length follows from the end above the horizon: the difference of coordinates would cancel.
        length = nusselt_min((rises ? z1 : z0) / abs(slope), length);
        // The first formula errs by rounding times the distance over the slope, the second by rounding times the
        // length: the better one gives z = 0 up to rounding also near the axis of the light.
        bool steep = distance < abs(slope) * nusselt_max(abs(start), abs(end));
        float crossing = steep ? -closest.z / slope : (rises ? end - length : start + length);
        vec3 on_horizon = vec3((crossing * s + closest).xy, 0.0);
        if (rises) {
            p0 = on_horizon;
            start = crossing;
        } else {
            p1 = on_horizon;
            end = crossing;
        }
    } else if (!(z0 >= 0.0 && z1 >= 0.0 && nusselt_max(p0.z, p1.z) > 0.0)) {
        length = 0.0;
    }
    return make_line_extent(s, p0, p1, closest, distance, start, end, length);
}

/// The extent of the part of a segment with z > 0, in shading space.
LineExtent clipped_extent(LineSegment line) {
    vec3 moment = nusselt_cross(line.p0, line.s);
    vec3 p1 = end_of(line);
    return clipped_extent(line.s, line.p0, p1, nusselt_cross(line.s, moment), sqrt(dot(moment, moment)),
                          dot(line.p0, line.s), dot(p1, line.s), line.len);
}

/// The integral 2 int cos(alpha) n . w(alpha) d alpha from the start of an extent to a point: the projected solid angle
/// per radius times the distance (E of Peters 2021, linear lights, Eq. 2 and 3). The first term can only be negative
/// where the second one is larger: no more than a factor of two is lost to cancellation.
/// \param theta      angle from the start to the point.
/// \param from_start see LinePoint.
/// \param heights    the cosines with the normal at the start and at the point, added.
/// \param n_t        component of the normal along t.
float cosine_integral(float theta, float from_start, float heights, float n_t) {
    return nusselt_max(nusselt_fma(n_t, x_minus_sin(theta), from_start * heights), 0.0);
}

/// The integral from end to end.
float cosine_integral(LineExtent e) {
    return cosine_integral(line_extent_sweep(e), e.sine_extent, e.height0 + e.height1, e.t.z);
}

/// Solid angle per radius of a linear light in the limit of a thin cylinder [sr/m], in any frame.
float solid_angle(LineSegment line) {
    float scale = scale_of(line);
    LineExtent e = make_line_extent(scaled(line, scale));
    return e.visible ? 2.0 * e.sine_extent / e.distance * scale : 0.0;
}

/// Projected solid angle per radius of the part of a linear light above the horizon in the limit of a thin cylinder
/// [sr/m], in shading space.
float projected_solid_angle(LineSegment line) {
    float scale = scale_of(line);
    LineExtent e = clipped_extent(scaled(line, scale));
    return e.visible ? cosine_integral(e) / e.distance * scale : 0.0;
}

#endif
