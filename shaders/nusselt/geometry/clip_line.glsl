#ifndef NUSSELT_GEOMETRY_CLIP_LINE_GLSL
#define NUSSELT_GEOMETRY_CLIP_LINE_GLSL
// Follows include/nusselt/geometry/clip_line.h @ 39f49f8f8ef3
/// Extents of line segments, whole or clipped to the upper hemisphere, and their closed forms. Twin of
/// include/nusselt/geometry/clip_line.h.

#include "../geometry/line_segment.glsl"

/// Power of two that brings the coordinates of a segment to order one, so that their squares stay in range.
float scale_of(const LineSegment line) {
    return reciprocal_power_of_two(nusselt_max(largest_component(line.p0), line.len));
}

LineSegment scaled(const LineSegment line, float scale) {
    return LineSegment(scale * line.p0, line.s, scale * line.len);
}

/// The end of a segment, each component rounded once: where it is close to the origin, adding the length to the coordinate
/// of the start would turn its direction.
vec3 end_of(const LineSegment line) { return exact_fma(line.len, line.s, line.p0); }

/// Squared: 4 roundings. A smaller distance of a line from the origin, relative to that of its points, cannot be distinguished
/// from rounding.
const float kNusseltSmallestSquaredDistance = 2.27373675443232059e-13;

/// A segment by coordinates along its line; without length if the line meets the origin up to rounding.
/// \param line with coordinates of order one.
CenteredLine centered(const LineSegment line) {
    // Subtract the part along the line in two steps, of which the first one rounds the difference only. What it leaves is the
    // error of the scalar product, and of the direction, which is not quite of unit length.
    float along = dot(line.p0, line.s);
    vec3 nearly = rounded_multiply_add(-along, line.s, line.p0);
    float rest = dot(nearly, line.s);
    float squared = nusselt_fma(-rest, rest, dot(nearly, nearly));
    float reach = nusselt_fma(line.len, line.len, dot(line.p0, line.p0));
    bool passes_by = squared > kNusseltSmallestSquaredDistance * reach;

    // Go from the near end to the far one. Either has a distance of 0 from the start.
    bool starts_near = nusselt_fma(2.0, along, line.len) >= 0.0;
    float sign_of_s = starts_near ? 1.0 : -1.0;
    vec3 end = rounded_multiply_add(line.len, line.s, line.p0);
    float l0 = along + rest;
    float l1 = (along + line.len) + rest;
    return CenteredLine(starts_near ? line.p0 : end, sign_of_s * line.s, nusselt_fma(-rest, line.s, nearly),
                        passes_by ? squared : 1.0, starts_near ? l0 : -l1, starts_near ? l1 : -l0,
                        starts_near ? end.z : line.p0.z, passes_by ? line.len : 0.0, sign_of_s);
}

/// Removes the part with z < 0. The line stays; only an end point moves, to z = 0 exactly.
CenteredLine clip_to_horizon(CenteredLine line) {
    float near_z = without_tiny(line.near.z);
    float far_z = without_tiny(line.far_z);
    bool rises = near_z < 0.0 && far_z > 0.0;
    bool falls = near_z > 0.0 && far_z < 0.0;
    if (rises || falls) {
        float slope = line.inward.z;
        // The remaining length follows from the end above the horizon: the difference of coordinates would cancel.
        float remaining = nusselt_min((rises ? far_z : near_z) / abs(slope), line.len);
        // The first formula errs by rounding times the distance over the slope, the second by rounding times the length: the
        // better one gives z = 0 up to rounding also near the axis of the light.
        float rise = slope * line.far_l;
        bool steep = line.squared < rise * rise;
        float from_end = rises ? line.far_l - remaining : line.near_l + remaining;
        float crossing = steep ? -line.closest.z / slope : from_end;
        vec3 on_horizon = vec3(nusselt_fma(crossing, line.inward, line.closest).xy, 0.0);
        line.len = remaining;
        if (rises) {
            line.near = on_horizon;
            line.near_l = crossing;
        } else if (crossing + line.near_l < 0.0) {
            // The new far end is the near one.
            line.far_l = -line.near_l;
            line.far_z = line.near.z;
            line.near = on_horizon;
            line.near_l = -crossing;
            line.inward = -line.inward;
            line.sign_of_s = -line.sign_of_s;
        } else {
            line.far_l = crossing;
            line.far_z = 0.0;
        }
    } else if (!(near_z >= 0.0 && far_z >= 0.0 && nusselt_max(line.near.z, line.far_z) > 0.0)) {
        line.len = 0.0;
    }
    line.near.z = nusselt_max(line.near.z, 0.0);
    line.far_z = nusselt_max(line.far_z, 0.0);
    return line;
}

/// The extent of a whole segment, in any frame.
/// \param line with coordinates of order one.
LineExtent whole_extent(const LineSegment line) { return make_line_extent(centered(line)); }

/// The extent of the part of a segment with z > 0, in shading space.
/// \param line with coordinates of order one.
LineExtent clipped_extent(const LineSegment line) { return make_line_extent(clip_to_horizon(centered(line))); }

/// The integral 2 int cos(alpha) n . w(alpha) d alpha along an extent above the horizon: the projected solid angle per
/// radius times the distance (E of Peters 2021, linear lights, Eq. 2 and 3). It is split in the middle of the angle between
/// the ends, from which angles are at most a quarter of a turn. By the end points, nothing cancels: with the sine and the
/// cosine at the normal relative to the middle, the integral up to a point is
///
///     n_t (theta - sin(theta)) + sine (middle_height + height).
///
/// The first term can only be negative where the second one is larger: no more than a factor of two is lost.
struct CosineIntegral {
    float middle_cosine, middle_height; ///< cosines of the middle direction with t and with the normal
    float near_height, far_height;      ///< those of the ends with the normal
    float from_near, to_far;            ///< differences between the sines of the ends and of the middle
    float bend;                         ///< n_t (theta - sin(theta)) for half the angle
    float near, far;                    ///< the integrals between the ends and the middle
};

CosineIntegral make_cosine_integral(const LineExtent e, float n_t) {
    CosineIntegral self;
    // The direction to the middle is the sum of both unit directions, over twice the cosine of half the angle between them.
    float root = sqrt(2.0 * e.product * e.one_plus_cosine);
    float inverse = e.product / root;
    float near_cosine = e.distance * e.near_inverse;
    float far_cosine = e.distance * e.far_inverse;
    self.near_height = e.line.near.z * e.near_inverse;
    self.far_height = e.line.far_z * e.far_inverse;
    self.middle_cosine = (near_cosine + far_cosine) * inverse;
    self.middle_height = (self.near_height + self.far_height) * inverse;
    float quarter_tangent = e.line.len * e.distance / (e.one_plus_cosine + root);
    if (line_extent_is_obtuse(e)) {
        // The sum nearly vanishes, but not the difference of the directions, which is perpendicular to the middle.
        float twice = e.product + e.product;
        float one_plus_cosine = line_extent_precise_one_plus_cosine(e);
        float difference = sqrt(twice * (twice - one_plus_cosine));
        float inverse_difference = e.product / difference;
        float sine = (near_cosine - far_cosine) * inverse_difference;
        self.middle_cosine = line_extent_sine_extent(e).difference * inverse_difference;
        self.middle_height = nusselt_fma(e.line.inward.z, sine, n_t * self.middle_cosine);
        quarter_tangent = difference / (twice + sqrt(twice * one_plus_cosine));
    }
    self.from_near = quarter_tangent * (self.middle_cosine + near_cosine);
    self.to_far = quarter_tangent * (self.middle_cosine + far_cosine);
    self.bend = n_t * angle_minus_sine(quarter_tangent);
    self.near = nusselt_max(nusselt_fma(self.from_near, self.middle_height + self.near_height, self.bend), 0.0);
    self.far = nusselt_max(nusselt_fma(self.to_far, self.middle_height + self.far_height, self.bend), 0.0);
    return self;
}

/// The integral from end to end.
float cosine_integral(const LineExtent e) {
    CosineIntegral halves = make_cosine_integral(e, line_extent_n_t(e));
    return halves.near + halves.far;
}

/// Solid angle per radius of a linear light in the limit of a thin cylinder [sr/m], in any frame.
float solid_angle(const LineSegment line) {
    float scale = scale_of(line);
    LineExtent e = whole_extent(scaled(line, scale));
    return line_extent_visible(e) ? 2.0 * line_extent_sine_extent(e).density * e.distance * scale : 0.0;
}

/// Projected solid angle per radius of the part of a linear light above the horizon in the limit of a thin cylinder
/// [sr/m], in shading space.
float projected_solid_angle(const LineSegment line) {
    float scale = scale_of(line);
    LineExtent e = clipped_extent(scaled(line, scale));
    return line_extent_visible(e) ? cosine_integral(e) / e.distance * scale : 0.0;
}

#endif
