#pragma once
/// Extents of line segments, whole or clipped to the upper hemisphere, and their closed forms.

#include <nusselt/geometry/line_segment.h>
#include <nusselt/geometry/scaled_light.h>

NUSSELT_NAMESPACE_BEGIN

/// Power of two that brings the coordinates of a segment to order one, so that their squares stay in range.
template <class Real>
NUSSELT_INLINE Real scale_of(const LineSegment<Real>& line) noexcept {
    return reciprocal_power_of_two(
        max(max(max(abs(line.p0.x), abs(line.p0.y)), abs(line.p0.z)), line.length));
}

template <class Real>
NUSSELT_INLINE LineSegment<Real> scaled(const LineSegment<Real>& line, const Real& scale) noexcept {
    return {scale * line.p0, line.s, scale * line.length};
}

/// The end of a segment, each component rounded once: where it is close to the origin, adding the length to
/// the coordinate of the start would turn its direction.
template <class Real>
NUSSELT_INLINE Vec3<Real> end_of(const LineSegment<Real>& line) noexcept {
    return fma(line.length, line.s, line.p0);
}

/// The extent of a whole segment, in any frame.
template <class Real>
NUSSELT_INLINE LineExtent<Real> make_line_extent(const LineSegment<Real>& line) noexcept {
    // Cross products with exact signs instead of p0 - (p0 . s) s, which loses the square of the distance.
    const Vec3<Real> moment = cross(line.p0, line.s);
    const Vec3<Real> end = end_of(line);
    return make_line_extent(line.s, line.p0, end, cross(line.s, moment), sqrt(dot(moment, moment)),
                            dot(line.p0, line.s), dot(end, line.s), line.length);
}

/// The part with z > 0 of a segment between two points of its line. The parameters of the line stay; only an end point
/// moves, to z = 0 exactly. Parameters as those of make_line_extent().
template <class Real>
NUSSELT_INLINE LineExtent<Real>
clipped_extent(const Vec3<Real>& s, const Vec3<Real>& p0, const Vec3<Real>& p1, const Vec3<Real>& closest,
               const Real& distance, const Real& start, const Real& end, const Real& length) noexcept {
    // Tell which ends lie above the horizon.
    const Real z0 = without_tiny(p0.z);
    const Real z1 = without_tiny(p1.z);
    const auto rises = (z0 < Real(0)) & (z1 > Real(0));
    const auto falls = (z0 > Real(0)) & (z1 < Real(0));
    const auto crosses = rises | falls;
    const auto all_above = (z0 >= Real(0)) & (z1 >= Real(0)) & (max(p0.z, p1.z) > Real(0));
    const auto lit = crosses | all_above;
    const Real visible_length = select(lit, length, Real(0));
    if (!any(crosses)) return make_line_extent(s, p0, p1, closest, distance, start, end, visible_length);

    // Find the crossing with the horizon.
    const Real slope = select(crosses, s.z, Real(1));
    // The remaining length follows from the end above the horizon: the difference of coordinates would cancel.
    const Real remaining = min(select(rises, z1, z0) / abs(slope), length);
    // The first formula errs by rounding times the distance over the slope, the second by rounding times the
    // length: the better one gives z = 0 up to rounding also near the axis of the light.
    const auto steep = distance < abs(slope) * max(abs(start), abs(end));
    const Real crossing =
        select(steep, -closest.z / slope, select(rises, end - remaining, start + remaining));

    // Replace the end that lies below.
    Vec3<Real> on_horizon = crossing * s + closest;
    on_horizon.z = Real(0);
    return make_line_extent(s, select(rises, on_horizon, p0), select(falls, on_horizon, p1), closest,
                            distance, select(rises, crossing, start), select(falls, crossing, end),
                            select(crosses, remaining, visible_length));
}

/// The extent of the part of a segment with z > 0, in shading space.
template <class Real>
NUSSELT_INLINE LineExtent<Real> clipped_extent(const LineSegment<Real>& line) noexcept {
    const Vec3<Real> moment = cross(line.p0, line.s);
    const Vec3<Real> p1 = end_of(line);
    return clipped_extent(line.s, line.p0, p1, cross(line.s, moment), sqrt(dot(moment, moment)),
                          dot(line.p0, line.s), dot(p1, line.s), line.length);
}

/// The integral 2 int cos(alpha) n . w(alpha) d alpha from the start of an extent to a point: the projected
/// solid angle per radius times the distance (E of Peters 2021, linear lights, Eq. 2 and 3). The first term
/// can only be negative where the second one is larger: no more than a factor of two is lost to cancellation.
/// \param theta      angle from the start to the point.
/// \param from_start see LinePoint.
/// \param heights    the cosines with the normal at the start and at the point, added.
/// \param n_t        component of the normal along t.
template <class Real>
NUSSELT_INLINE Real cosine_integral(const Real& theta, const Real& from_start, const Real& heights,
                                    const Real& n_t) noexcept {
    return max(fma(n_t, x_minus_sin(theta), from_start * heights), Real(0));
}

/// The integral from end to end.
template <class Real>
NUSSELT_INLINE Real cosine_integral(const LineExtent<Real>& e) noexcept {
    return cosine_integral(e.sweep(), e.sine_extent, e.height0 + e.height1, e.t.z);
}

/// Solid angle per radius of a linear light in the limit of a thin cylinder [sr/m], in any frame.
template <class Real>
NUSSELT_HD inline Real solid_angle(const LineSegment<Real>& line) noexcept {
    const auto unit = to_unit_extent(line);
    const LineExtent<Real> e = make_line_extent(unit.light);
    return select(e.visible, Real(2) * e.sine_extent / e.distance * unit.scale, Real(0));
}

/// Projected solid angle per radius of the part of a linear light above the horizon in the limit of a thin
/// cylinder [sr/m], in shading space.
template <class Real>
NUSSELT_HD inline Real projected_solid_angle(const LineSegment<Real>& line) noexcept {
    const auto unit = to_unit_extent(line);
    const LineExtent<Real> e = clipped_extent(unit.light);
    return select(e.visible, cosine_integral(e) / e.distance * unit.scale, Real(0));
}

NUSSELT_NAMESPACE_END
