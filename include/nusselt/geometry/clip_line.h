#pragma once
/// Extents of line segments, whole or clipped to the upper hemisphere, and their closed forms.

#include <nusselt/geometry/line_segment.h>

NUSSELT_NAMESPACE_BEGIN

/// Power of two that brings the coordinates of a segment to order one, so that their squares stay in range.
template <class Real>
NUSSELT_HD inline Real scale_of(const LineSegment<Real>& line) noexcept {
    return reciprocal_power_of_two(
        max(max(max(abs(line.p0.x), abs(line.p0.y)), abs(line.p0.z)), line.length));
}

template <class Real>
NUSSELT_HD inline LineSegment<Real> scaled(const LineSegment<Real>& line, const Real& scale) noexcept {
    return {scale * line.p0, line.s, scale * line.length};
}

/// The end of a segment, each component rounded once: where it is close to the origin, adding the length to
/// the coordinate of the begin would turn its direction.
template <class Real>
NUSSELT_HD inline Vec3<Real> end_of(const LineSegment<Real>& line) noexcept {
    return {fma(line.length, line.s.x, line.p0.x), fma(line.length, line.s.y, line.p0.y),
            fma(line.length, line.s.z, line.p0.z)};
}

/// The extent of a whole segment, in any frame.
template <class Real>
NUSSELT_HD inline LineExtent<Real> make_line_extent(const LineSegment<Real>& line) noexcept {
    // Cross products with exact signs instead of p0 - (p0 . s) s, which loses the square of the distance.
    const Vec3<Real> moment = cross(line.p0, line.s);
    const Real begin = dot(line.p0, line.s);
    return make_line_extent(line.s, cross(line.s, moment), length(moment), begin, dot(end_of(line), line.s),
                            line.length);
}

/// The extent of the part of a segment with z > 0, in shading space. The parameters of the line stay; only
/// the coordinate of an end point moves, and its direction gets z = 0 exactly.
template <class Real>
NUSSELT_HD inline LineExtent<Real> clipped_extent(const LineSegment<Real>& line) noexcept {
    const Vec3<Real> moment = cross(line.p0, line.s);
    const Vec3<Real> closest = cross(line.s, moment);
    const Real distance = length(moment);
    const Vec3<Real> p1 = end_of(line);
    const Real begin = dot(line.p0, line.s);
    const Real end = dot(p1, line.s);
    const Real z0 = line.p0.z;
    const Real z1 = p1.z;
    const auto rises = (z0 < Real(0)) & (z1 > Real(0));
    const auto falls = (z0 > Real(0)) & (z1 < Real(0));
    const auto crosses = rises | falls;
    const Real slope = select(crosses, line.s.z, Real(1));
    // What remains follows from the end above the horizon: the difference of coordinates would cancel.
    const Real remaining = min(select(rises, z1, z0) / abs(slope), line.length);
    const auto lit = (z0 > Real(0)) | (z1 > Real(0));
    const Real visible_length = select(lit, select(crosses, remaining, line.length), Real(0));
    // The first formula errs by rounding times the distance over the slope, the second by rounding times the
    // length: the better one gives z = 0 up to rounding also near the axis of the light.
    const auto steep = distance < abs(slope) * max(abs(begin), abs(end));
    const Real crossing =
        select(steep, -closest.z / slope, select(rises, end - remaining, begin + remaining));
    LineExtent<Real> extent = make_line_extent(line.s, closest, distance, select(rises, crossing, begin),
                                               select(falls, crossing, end), visible_length);
    extent.d0.z = select(rises, Real(0), max(extent.d0.z, Real(0)));
    extent.d1.z = select(falls, Real(0), max(extent.d1.z, Real(0)));
    return extent;
}

/// The integral 2 int cos(alpha) n . w(alpha) d alpha from the begin of an extent to a point: the projected
/// solid angle per radius times the distance (E of Peters 2021, linear lights, Eq. 2 and 3). The first term
/// can only be negative where the second one is larger: no more than a factor of two is lost to cancellation.
/// \param theta   angle from the begin to the point.
/// \param sin     its sine.
/// \param tangent of theta / 2.
/// \param cosines the cosines with t at the begin and at the point, added.
/// \param heights the cosines with the normal at the begin and at the point, added.
/// \param n_t     component of the normal along t.
template <class Real>
NUSSELT_HD inline Real cosine_integral(const Real& theta, const Real& sin, const Real& tangent,
                                       const Real& cosines, const Real& heights, const Real& n_t) noexcept {
    return max(fma(n_t, x_minus_sin(theta, sin), tangent * cosines * heights), Real(0));
}

/// Solid angle per radius of a linear light in the limit of a thin cylinder [sr/m], in any frame.
template <class Real>
NUSSELT_HD inline Real solid_angle(const LineSegment<Real>& line) noexcept {
    const Real scale = scale_of(line);
    const LineExtent<Real> e = make_line_extent(scaled(line, scale));
    const Real whole = Real(2) * e.sine_extent() / select(e.visible, e.distance, Real(1)) * scale;
    return select(e.visible, whole, Real(0));
}

/// Projected solid angle per radius of the part of a linear light above the horizon in the limit of a thin
/// cylinder [sr/m], in shading space.
template <class Real>
NUSSELT_HD inline Real projected_solid_angle(const LineSegment<Real>& line) noexcept {
    const Real scale = scale_of(line);
    const LineExtent<Real> e = clipped_extent(scaled(line, scale));
    const Real integral =
        cosine_integral(e.sweep, e.sin_sweep, e.tan_half_sweep, e.c0 + e.c1, e.d0.z + e.d1.z, e.t.z);
    return select(e.visible, integral / select(e.visible, e.distance, Real(1)) * scale, Real(0));
}

NUSSELT_NAMESPACE_END
