#ifndef NUSSELT_GEOMETRY_LINE_SEGMENT_GLSL
#define NUSSELT_GEOMETRY_LINE_SEGMENT_GLSL
// Follows include/nusselt/geometry/line_segment.h @ efee6853a19f
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
LineSegment to_shading_space(const LineSegment world, vec3 point, const Frame frame) {
    return LineSegment(frame_to_local(frame, world.p0 - point), frame_to_local(frame, world.s), world.len);
}

/// A segment from the end nearer to the origin to the other one, with coordinates along its infinite line that are 0 at
/// the point closest to the origin.
struct CenteredLine {
    vec3 near;           ///< end point
    vec3 inward;         ///< unit direction from there to the far end
    vec3 closest;        ///< the point of the infinite line closest to the origin
    float squared;       ///< squared distance of that point from the origin, positive
    float near_l, far_l; ///< coordinates of the end points; far_l is not less than |near_l|
    float far_z;         ///< of the far end
    float len;           ///< far_l - near_l, which may be known more accurately; 0 if there is no light
    float sign_of_s;     ///< 1 if the near end is the start, else -1
};

/// The segment between two points of a line.
/// \param s unit direction from p0 to p1.
/// \param closest, squared, len as in CenteredLine.
/// \param l0, l1 coordinates of the points along s.
CenteredLine line_between(vec3 s, vec3 p0, vec3 p1, vec3 closest, float squared, float l0, float l1, float len) {
    if (l0 + l1 >= 0.0) return CenteredLine(p0, s, closest, squared, l0, l1, p1.z, len, 1.0);
    return CenteredLine(p1, -s, closest, squared, -l1, -l0, p0.z, len, -1.0);
}

/// The angles under which the origin sees a segment. In the half-plane that it spans with the origin, t leads to the point
/// of the infinite line that is closest to the origin, and s from the end of the segment that is nearer to the origin to the
/// other one: a point of the light is distance * (tan(alpha) s + t), its direction sin(alpha) s + cos(alpha) t. Peters 2021
/// (linear lights), Sec. 3.1, in terms of the end points, so that short, distant or nearly aligned segments keep their
/// relative precision. The unit of length is arbitrary.
struct LineExtent {
    CenteredLine line;
    float distance;                  ///< of the infinite line from the origin
    float near_distance;             ///< of the near end from the origin
    float near_inverse, far_inverse; ///< reciprocal distances of the ends
    float near_inverse_squared, far_inverse_squared;
    float product; ///< of the distances of both ends
    /// The product times one plus the cosine of the angle between the ends, which is at most half a turn. Its error is
    /// relative to the product: see line_extent_precise_one_plus_cosine().
    float one_plus_cosine;
};

/// Component of the normal along t.
float line_extent_n_t(const LineExtent self) { return self.line.closest.z / self.distance; }

struct SineExtent {
    float difference; ///< far sine minus near sine, accurate relative to itself
    float density;    ///< the same over the squared distance of the line
};

/// The density of SineExtent as a ratio, whose reciprocal does not wait for it.
struct SineRatio {
    float numerator;   ///< 0 without light
    float denominator; ///< positive
};

SineRatio line_extent_sine_ratio(const LineExtent self) {
    // The tangent of half the angle between the ends times the sum of the cosines (Eq. 1) does not cancel. If the closest
    // point lies between the ends, nor do the sines.
    bool surrounds = self.line.near_l < 0.0;
    float difference = self.line.far_l * self.far_inverse - self.line.near_l * self.near_inverse;
    return SineRatio(surrounds && self.line.len > 0.0 ? difference
                                                      : self.line.len * (self.near_inverse + self.far_inverse),
                     surrounds ? self.line.squared : self.one_plus_cosine);
}

SineExtent line_extent_sine_extent(const LineExtent self) {
    SineRatio ratio = line_extent_sine_ratio(self);
    float density = ratio.numerator / ratio.denominator;
    return SineExtent(self.line.near_l < 0.0 ? ratio.numerator : self.line.squared * density, density);
}

/// Whether there is light and the angle between its ends exceeds a quarter of a turn.
bool line_extent_is_obtuse(const LineExtent self) { return self.one_plus_cosine < self.product && self.line.len > 0.0; }

/// one_plus_cosine of an obtuse angle, accurate relative to itself: the closest point lies between the ends.
float line_extent_precise_one_plus_cosine(const LineExtent self) {
    float squares =
        nusselt_fma(self.line.near_l, self.line.near_l, nusselt_fma(self.line.far_l, self.line.far_l, self.line.squared));
    float sum = nusselt_fma(-self.line.near_l, self.line.far_l, self.product);
    return self.line.squared * (1.0 + squares / sum);
}

/// False if the segment has no length or its line passes through the origin.
bool line_extent_visible(const LineExtent self) { return self.line.len * self.distance > 0.0; }

/// The extent of a segment.
LineExtent make_line_extent(const CenteredLine line) {
    LineExtent e;
    e.line = line;
    e.distance = sqrt(line.squared);
    float near_squared = nusselt_fma(line.near_l, line.near_l, line.squared);
    float far_squared = nusselt_fma(line.far_l, line.far_l, line.squared);
    e.near_inverse_squared = 1.0 / near_squared;
    e.far_inverse_squared = 1.0 / far_squared;
    e.near_distance = sqrt(near_squared);
    float far_distance = sqrt(far_squared);
    e.near_inverse = e.near_distance * e.near_inverse_squared;
    e.far_inverse = far_distance * e.far_inverse_squared;
    e.product = e.near_distance * far_distance;
    e.one_plus_cosine = e.product + nusselt_fma(line.near_l, line.far_l, line.squared);
    return e;
}

/// A point of a segment.
struct LinePoint {
    float share;            ///< sine of its angle minus that of the near end, over that of the far end minus that of the near end
    float inverse_distance; ///< reciprocal distance from the origin
};

/// The map from sines of angles to directions and points of a segment.
struct LineMap {
    vec3 near;    ///< the end nearer to the origin
    vec3 inward;  ///< s
    vec3 closest; ///< the point of the infinite line closest to the origin
    float len;
    float near_inverse; ///< reciprocal distance of the near end
    float near_inverse_squared, far_inverse_squared;
    float near_sine, sine_extent; ///< far sine minus near sine, accurate relative to itself
    float squared_density;        ///< of sine_extent over the distance of the line
    float step_scale;
};

LineMap make_line_map(const LineExtent e) {
    SineExtent sines = line_extent_sine_extent(e);
    return LineMap(e.line.near, e.line.inward, e.line.closest, e.line.len, e.near_inverse, e.near_inverse_squared,
                   e.far_inverse_squared, e.line.near_l * e.near_inverse, sines.difference,
                   sines.difference * sines.density, 2.0 * e.near_distance * sines.density);
}

/// \param share in [0, 1], see LinePoint.
LinePoint line_map_point_at(const LineMap self, float share) {
    // With sines (1 - x) s0 + x s1, the squared cosines are (1 - x) c0^2 + x c1^2 + x (1 - x) (s1 - s0)^2: a sum of positive
    // terms. Here it is divided by the squared distance of the line.
    float near_part = nusselt_fma(share, self.squared_density, self.near_inverse_squared);
    return LinePoint(share, sqrt(nusselt_fma(share, self.far_inverse_squared, (1.0 - share) * near_part)));
}

float line_map_sine_at(const LineMap self, float share) { return nusselt_fma(share, self.sine_extent, self.near_sine); }

/// The point itself, on the segment.
vec3 line_map_position(const LineMap self, const LinePoint point) {
    // A point much closer to the origin than both ends would suffer from their rounding. It lies far from them.
    bool beside = point.inverse_distance > 2.0 * self.near_inverse;
    // Else the nearer end is the more accurate place to start from. With the tangent T of half the angle between that end
    // and the point, the step is 2 T / (1 + T^2) times the distance of the end over the cosine of alpha.
    float sum = self.near_inverse + point.inverse_distance;
    float squares = nusselt_fma(sum, sum, point.share * point.share * self.squared_density);
    float dividend = beside ? line_map_sine_at(self, point.share) : self.step_scale * point.share * sum;
    float l = dividend / (beside ? point.inverse_distance : point.inverse_distance * squares);
    return nusselt_fma(beside ? l : nusselt_min(l, self.len), self.inward, beside ? self.closest : self.near);
}

/// Unit direction to a point.
/// \param p its position.
vec3 line_map_direction(const LineMap self, const LinePoint point, vec3 p) { return point.inverse_distance * p; }

/// The share of the point in a unit direction that hits the segment up to rounding, in [0, 1].
float line_map_share_in(const LineMap self, vec3 wi) {
    float distance = sqrt(dot(self.closest, self.closest));
    float along = dot(wi, self.inward);
    float across = nusselt_max(dot(wi, self.closest) / (distance > 0.0 ? distance : 1.0), 0.0);
    // The angle from the end on the same side of the closest point is acute.
    bool before_closest = along < 0.0;
    float end_sine = before_closest ? self.near_sine : self.near_sine + self.sine_extent;
    float end_cosine = distance * (before_closest ? self.near_inverse : sqrt(self.far_inverse_squared));
    float turned = difference_of_products(along, end_cosine, across, end_sine);
    float sine = nusselt_max(before_closest ? turned : -turned, 0.0);
    float cosine = nusselt_max(nusselt_fma(along, end_sine, across * end_cosine), 0.0);
    float sines = sine / (1.0 + cosine) * (end_cosine + across);
    float share = nusselt_min(sines / (self.sine_extent > 0.0 ? self.sine_extent : 1.0), 1.0);
    return before_closest ? share : 1.0 - share;
}

#endif
