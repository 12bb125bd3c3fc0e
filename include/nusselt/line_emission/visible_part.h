#pragma once
/// The parts of linear lights, strips and tubes whose spread reaches a point. Samples of the rest would be black: a spread of 1
/// degree would add noise to a long light.
///
/// A spread of slope t (RadialSpread of emission/spread.h) acts around the normals of a light. A thin tube has normals in all
/// directions across its axis, so that at the distance d, light arrives from t d before to t d behind the point. Parts are a
/// little longer because of rounding; multiply by the share that passes, as for the whole light.

#include <nusselt/geometry/line_segment.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// The part of a line between two places.
template <class Real>
NUSSELT_HD inline LineSegment<Real> part_between(const LineSegment<Real>& line, const Real& from,
                                                 const Real& to) noexcept {
    const Real low = min(max(from, Real(0)), line.length);
    const Real high = min(max(to, low), line.length);
    return {multiply_add(low, line.s, line.p0), line.s, high - low};
}

/// More than the rounding errors of places along a line where slopes in units of the distance end.
template <class Real>
NUSSELT_HD inline Real place_rounding(const LineSegment<Real>& line, const Real& slope) noexcept {
    const Real extent = max(max(abs(line.p0.x), abs(line.p0.y)), max(abs(line.p0.z), line.length));
    return Real(8 * std::numeric_limits<scalar_t<Real>>::epsilon()) * (Real(1) + slope) * extent;
}

/// How far along a line the spread of its tube reaches the origin, from the place next to the origin on.
template <class Real>
NUSSELT_HD inline Real tube_reach(const LineSegment<Real>& line, const Real& foot,
                                  const Real& slope) noexcept {
    return multiply_add(slope, length(multiply_add(foot, line.s, line.p0)), place_rounding(line, slope));
}

} // namespace detail

/// The part of a linear light whose spread reaches the origin.
/// \param line  in shading space [m].
/// \param slope t, the tangent of half of the spread; above 0.
/// \returns a segment of the length 0 if nothing reaches the origin.
template <class Real>
NUSSELT_HD inline LineSegment<Real> visible_part(const LineSegment<Real>& line, const Real& slope) noexcept {
    const Real foot = -dot(line.p0, line.s);
    const Real reach = detail::tube_reach(line, foot, slope);
    return detail::part_between(line, foot - reach, foot + reach);
}

/// The same for the axis of a tube. If the origin is beyond an end, at least the radius remains there: the cap may shine where
/// the lateral surface does not. Where an end is cut off, the origin does not see the face of the cut.
/// \param axis   in shading space [m].
/// \param radius of the tube [m]; above 0.
template <class Real>
NUSSELT_HD inline LineSegment<Real> visible_part_of_tube(const LineSegment<Real>& axis, const Real& radius,
                                                         const Real& slope) noexcept {
    const Real foot = -dot(axis.p0, axis.s);
    const Real reach = detail::tube_reach(axis, foot, slope);
    const Real nearest = min(max(foot, Real(0)), axis.length);
    const Real least = select(nearest == foot, Real(0), radius);
    return detail::part_between(axis, min(foot - reach, nearest - least), max(foot + reach, nearest + least));
}

/// The same for the middle line of a strip, which shines to both sides.
/// \param normal unit, perpendicular to the line.
template <class Real>
NUSSELT_HD inline LineSegment<Real>
visible_part_of_strip(const LineSegment<Real>& line, const Vec3<Real>& normal, const Real& slope) noexcept {
    const Real foot = -dot(line.p0, line.s);
    const Real rounding = detail::place_rounding(line, slope);
    // What directions have of the slope across the line is missing along the line.
    const Real whole = multiply_add(slope, abs(dot(line.p0, normal)), rounding);
    const Real across = abs(dot(line.p0, cross(normal, line.s)));
    const Real squared = (whole - across) * (whole + across);
    const Real reach = sqrt(max(squared, Real(0))) + rounding;
    const LineSegment<Real> part = detail::part_between(line, foot - reach, foot + reach);
    return {part.p0, part.s, select(squared > Real(0), part.length, Real(0))};
}

NUSSELT_NAMESPACE_END
