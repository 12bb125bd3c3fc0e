#ifndef NUSSELT_GEOMETRY_LINE_SEGMENT_GLSL
#define NUSSELT_GEOMETRY_LINE_SEGMENT_GLSL
// Follows include/nusselt/geometry/line_segment.h @ 3f5fd28b510b
/// Line segments, and the angles under which a shading point sees them. Twin of
/// include/nusselt/geometry/line_segment.h.

#include "../core/frame.glsl"
#include "../core/trig.glsl"

/// A linear light: a cylinder whose radius tends to zero.
struct LineSegment {
    vec3 p0;      ///< start [m]
    vec3 s;       ///< unit direction from start to end; zero if both ends coincide
    float len;    ///< length [m]
};

/// The segment from start to end [m].
LineSegment make_line(vec3 start, vec3 end) {
    return LineSegment(start, nusselt_normalize(end - start), nusselt_length(end - start));
}

/// The segment seen from a shading point: the point becomes the origin, the normal of the frame +z.
LineSegment to_shading_space(LineSegment world, vec3 point, Frame frame) {
    return LineSegment(frame_to_local(frame, world.p0 - point), frame_to_local(frame, world.s), world.len);
}

/// A point of a line extent, given by sine and cosine of its angle alpha.
struct LinePoint {
    float sine, cosine; ///< of alpha
    float from_start;   ///< sine minus that of the start, accurate relative to itself
    float to_end;       ///< sine of the end minus this one, likewise
};

/// A segment in the half-plane that it spans with the origin, as angles alpha about the origin: a point of the light is
/// distance * (tan(alpha) s + t), its direction sin(alpha) s + cos(alpha) t. Peters 2021 (linear lights), Sec. 3.1, in
/// terms of the end points, so that short, distant or nearly aligned segments keep their relative precision. The unit
/// of length is arbitrary.
struct LineExtent {
    vec3 s, t;      ///< orthonormal; t points from the origin to the closest point of the infinite line
    float distance; ///< of the infinite line from the origin
    float len;
    float l0, l1;                    ///< coordinates of the end points along s, 0 at the closest point
    float s0, s1, c0, c1;            ///< sines and cosines of the angles of the end points
    float height0, height1;          ///< z of the unit directions to the end points, not negative
    float one_plus_s0, one_minus_s1; ///< accurate relative to themselves
    float half_tangent; ///< tangent of half the sweep or of half its supplement, whichever is acute; the sweep is the
                        ///< angle between the end points, at most half a turn
    float sine_extent;  ///< s1 - s0, accurate relative to itself
    vec3 near, inward;  ///< the end point nearer to the origin, and the direction to the other one
    float near_distance, near_cosine; ///< from the origin, and of the angle alpha
    bool starts_near; ///< whether it is the start
    bool acute;       ///< whether the sweep is
    bool visible;     ///< false if the segment has no length or its line passes through the origin
};

/// Angle between the end points.
float line_extent_sweep(LineExtent self) {
    float angle = 2.0 * atan_up_to_one(self.half_tangent);
    return self.acute ? angle : kNusseltPi - angle;
}

/// \param from_start sine minus s0, in [0, sine_extent].
LinePoint line_extent_point_at(LineExtent self, float from_start) {
    float to_end = nusselt_max(self.sine_extent - from_start, 0.0);
    // The square of the cosine is (1 + sine) (1 - sine): sums of positive terms.
    float squared = (self.one_plus_s0 + from_start) * (self.one_minus_s1 + to_end);
    return LinePoint(self.s0 + from_start, sqrt(squared), from_start, to_end);
}

/// Whether a point is much closer to the origin than both ends are.
bool line_extent_is_beside(LineExtent self, LinePoint point) { return point.cosine > 2.0 * self.near_cosine; }

/// The point itself, on the segment.
vec3 line_extent_position(LineExtent self, LinePoint point) {
    if (line_extent_is_beside(self, point)) {
        float l = self.distance * point.sine / point.cosine;
        return nusselt_min(nusselt_max(l, self.l0), self.l1) * self.s + self.distance * self.t;
    }
    // The nearer end is the more accurate place to start from. The step is 2 sin(theta / 2) cos(theta / 2) times its
    // distance over the cosine of alpha, with tan(theta / 2) = tangent.
    float tangent = (self.starts_near ? point.from_start : point.to_end) / (self.near_cosine + point.cosine);
    float step = 2.0 * self.near_distance * tangent / (point.cosine * nusselt_fma(tangent, tangent, 1.0));
    return self.near + nusselt_min(step, self.len) * self.inward;
}

/// Unit direction to a point.
/// \param p its position.
vec3 line_extent_direction(LineExtent self, LinePoint point, vec3 p) {
    if (line_extent_is_beside(self, point)) return point.sine * self.s + point.cosine * self.t;
    return inverse_length(p) * p;
}

/// The point in a unit direction that hits the segment up to rounding.
LinePoint line_extent_point_in(LineExtent self, vec3 wi) {
    float along = dot(wi, self.s);
    float across = nusselt_max(dot(wi, self.t), 0.0);
    // The angle from the end on the same side of the closest point is acute.
    bool before_closest = along < 0.0;
    float end_sine = before_closest ? self.s0 : self.s1;
    float end_cosine = before_closest ? self.c0 : self.c1;
    float turned = difference_of_products(along, end_cosine, across, end_sine);
    float sine = nusselt_max(before_closest ? turned : -turned, 0.0);
    float cosine = nusselt_max(nusselt_fma(along, end_sine, across * end_cosine), 0.0);
    float step = nusselt_min(sine / (1.0 + cosine) * (end_cosine + across), self.sine_extent);
    float rest = self.sine_extent - step;
    return LinePoint(along, across, before_closest ? step : rest, before_closest ? rest : step);
}

/// 4 roundings: for coordinates of order one, a smaller distance of a line from the origin cannot be distinguished from
/// rounding.
const float kNusseltSmallestDistance = 4.76837158203125e-7;

/// The part of a segment between two points of its line.
/// \param p0, p1   the points; z only matters where it is the height above the surface.
/// \param closest  vector to the closest point of the line.
/// \param distance its length.
/// \param l0, l1   coordinates of the points along the line.
/// \param length   l1 - l0, which the caller may have more accurately.
LineExtent make_line_extent(vec3 s, vec3 p0, vec3 p1, vec3 closest, float distance, float l0, float l1, float length) {
    LineExtent e;
    bool passes_by = distance > kNusseltSmallestDistance && length > 0.0;
    // If there is no light, any values will do that keep the formulas finite.
    e.distance = passes_by ? distance : 1.0;
    e.s = s;
    e.t = (1.0 / e.distance) * closest;
    e.len = length;
    e.l0 = l0;
    e.l1 = l1;
    float r0 = sqrt(nusselt_fma(l0, l0, e.distance * e.distance));
    float r1 = sqrt(nusselt_fma(l1, l1, e.distance * e.distance));
    float inverse_r0 = 1.0 / r0;
    float inverse_r1 = 1.0 / r1;
    e.s0 = l0 * inverse_r0;
    e.s1 = l1 * inverse_r1;
    e.c0 = e.distance * inverse_r0;
    e.c1 = e.distance * inverse_r1;
    e.height0 = nusselt_max(p0.z, 0.0) / r0;
    e.height1 = nusselt_max(p1.z, 0.0) / r1;
    float one_plus_abs0 = 1.0 + abs(e.s0);
    float one_plus_abs1 = 1.0 + abs(e.s1);
    e.one_plus_s0 = e.s0 < 0.0 ? e.c0 * e.c0 / one_plus_abs0 : one_plus_abs0;
    e.one_minus_s1 = e.s1 > 0.0 ? e.c1 * e.c1 / one_plus_abs1 : one_plus_abs1;
    e.starts_near = r0 <= r1;
    e.near = e.starts_near ? p0 : p1;
    e.inward = e.starts_near ? s : -s;
    e.near_distance = nusselt_min(r0, r1);
    e.near_cosine = nusselt_max(e.c0, e.c1);
    // The sine of the sweep is the area of the triangle with the origin, never a difference.
    float sin_sweep = (length * inverse_r0) * e.c1;
    float cos_sweep = nusselt_fma(e.c0, e.c1, e.s0 * e.s1);
    e.visible = passes_by && sin_sweep > 0.0;
    e.acute = cos_sweep > 0.0;
    e.half_tangent = sin_sweep / (1.0 + abs(cos_sweep));
    // Beyond a quarter of a turn the closest point lies between the ends: both sines add up.
    e.sine_extent = e.acute ? e.half_tangent * (e.c0 + e.c1) : e.s1 - e.s0;
    return e;
}

#endif
