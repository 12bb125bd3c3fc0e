#pragma once
/// Line segments, and the angles under which a shading point sees them.

#include <nusselt/core/frame.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// A linear light: a cylinder whose radius tends to zero.
template <class Real>
struct LineSegment {
    Vec3<Real> p0; ///< start [m]
    Vec3<Real> s;  ///< unit direction from start to end; zero if both ends coincide
    Real length;   ///< [m]
};

/// The same segment in all lanes.
template <class Real, class Single>
NUSSELT_INLINE LineSegment<Real> broadcast(const LineSegment<Single>& line) noexcept {
    return {broadcast<Real>(line.p0), broadcast<Real>(line.s), Real(line.length)};
}

/// The segment from start to end [m].
template <class Real>
NUSSELT_INLINE LineSegment<Real> make_line(const Vec3<Real>& start, const Vec3<Real>& end) noexcept {
    const Vec3<Real> extent = end - start;
    return {start, normalize(extent), length(extent)};
}

/// The segment seen from a shading point: the point becomes the origin, the normal of the frame +z.
/// \tparam Real may be a pack while the segment is scalar: one light, a shading point per lane.
template <class Real, class LightReal>
NUSSELT_INLINE LineSegment<Real> to_shading_space(const LineSegment<LightReal>& world,
                                                  const Vec3<Real>& point,
                                                  const Frame<Real>& frame) noexcept {
    return {frame.to_local(broadcast<Real>(world.p0) - point), frame.to_local(broadcast<Real>(world.s)),
            Real(world.length)};
}

/// A point of a line extent, given by sine and cosine of its angle alpha.
template <class Real>
struct LinePoint {
    Real sine, cosine; ///< of alpha
    Real from_start;   ///< sine minus that of the start, accurate relative to itself
    Real to_end;       ///< sine of the end minus this one, likewise
};

/// A segment in the half-plane that it spans with the origin, as angles alpha about the origin: a point of
/// the light is distance * (tan(alpha) s + t), its direction sin(alpha) s + cos(alpha) t. Peters 2021 (linear
/// lights), Sec. 3.1, in terms of the end points, so that short, distant or nearly aligned segments keep their
/// relative precision. The unit of length is arbitrary.
template <class Real>
struct LineExtent {
    Vec3<Real> s, t; ///< orthonormal; t points from the origin to the closest point of the infinite line
    Real distance;   ///< of the infinite line from the origin
    Real length;
    Real l0, l1;                    ///< coordinates of the end points along s, 0 at the closest point
    Real s0, s1, c0, c1;            ///< sines and cosines of the angles of the end points
    Real height0, height1;          ///< z of the unit directions to the end points, not negative
    Real one_plus_s0, one_minus_s1; ///< accurate relative to themselves
    Real sin_sweep;          ///< sine of the sweep, the angle between the end points, at most half a turn
    Real half_tangent;       ///< tangent of half the sweep or of half its supplement, whichever is acute
    Real sine_extent;        ///< s1 - s0, accurate relative to itself
    Vec3<Real> near, inward; ///< the end point nearer to the origin, and the direction to the other one
    Real near_distance, near_cosine; ///< from the origin, and of the angle alpha
    mask_t<Real> starts_near;        ///< whether it is the start
    mask_t<Real> acute;              ///< whether the sweep is
    mask_t<Real> visible; ///< false if the segment has no length or its line passes through the origin

    /// Angle between the end points.
    NUSSELT_HD Real sweep() const noexcept {
        const Real angle = Real(2) * atan_up_to_one(half_tangent);
        return select(acute, angle, Real(kPi<scalar_t<Real>>) - angle);
    }

    /// \param from_start sine minus s0, in [0, sine_extent]
    NUSSELT_HD LinePoint<Real> point_at(const Real& from_start) const noexcept {
        const Real to_end = max(sine_extent - from_start, Real(0));
        // The square of the cosine is (1 + sine) (1 - sine): sums of positive terms.
        const Real squared = (one_plus_s0 + from_start) * (one_minus_s1 + to_end);
        return {s0 + from_start, sqrt(squared), from_start, to_end};
    }

    /// The point itself, on the segment.
    NUSSELT_HD Vec3<Real> position(const LinePoint<Real>& point) const noexcept {
        // The nearer end is the more accurate place to start from. The step is 2 sin(theta / 2) cos(theta / 2)
        // times its distance over the cosine of alpha, with tan(theta / 2) = tangent.
        const Real tangent =
            select(starts_near, point.from_start, point.to_end) / (near_cosine + point.cosine);
        const Real step = Real(2) * near_distance * tangent / (point.cosine * fma(tangent, tangent, Real(1)));
        const Vec3<Real> p = near + min(step, length) * inward;
        const auto beside = is_beside(point);
        if (!any(beside)) return p;
        const Real l = distance * point.sine / point.cosine;
        return select(beside, min(max(l, l0), l1) * s + distance * t, p);
    }

    /// Unit direction to a point.
    /// \param p its position.
    NUSSELT_HD Vec3<Real> direction(const LinePoint<Real>& point, const Vec3<Real>& p) const noexcept {
        Vec3<Real> wi = inverse_length(p) * p;
        const auto beside = is_beside(point);
        if (any(beside)) wi = select(beside, point.sine * s + point.cosine * t, wi);
        return wi;
    }

    /// The point in a unit direction that hits the segment up to rounding.
    NUSSELT_HD LinePoint<Real> point_in(const Vec3<Real>& wi) const noexcept {
        const Real along = dot(wi, s);
        const Real across = max(dot(wi, t), Real(0));
        // The angle from the end on the same side of the closest point is acute.
        const auto before_closest = along < Real(0);
        const Real end_sine = select(before_closest, s0, s1);
        const Real end_cosine = select(before_closest, c0, c1);
        const Real turned = difference_of_products(along, end_cosine, across, end_sine);
        const Real sin = max(select(before_closest, turned, -turned), Real(0));
        const Real cos = max(fma(along, end_sine, across * end_cosine), Real(0));
        const Real step = min(sin / (Real(1) + cos) * (end_cosine + across), sine_extent);
        const Real rest = sine_extent - step;
        return {along, across, select(before_closest, step, rest), select(before_closest, rest, step)};
    }

private:
    /// Whether a point is much closer to the origin than both ends are.
    NUSSELT_HD mask_t<Real> is_beside(const LinePoint<Real>& point) const noexcept {
        return point.cosine > Real(2) * near_cosine;
    }
};

/// With coordinates of order one, a smaller distance of a line from the origin cannot be distinguished from rounding.
template <class Scalar>
inline constexpr Scalar kSmallestDistance = 4 * std::numeric_limits<Scalar>::epsilon();

/// The part of a segment between two points of its line.
/// \param p0, p1   the points; z only matters where it is the height above the surface.
/// \param closest  vector to the closest point of the line.
/// \param distance its length.
/// \param l0, l1   coordinates of the points along the line.
/// \param length   l1 - l0, which the caller may have more accurately.
template <class Real>
NUSSELT_INLINE LineExtent<Real>
make_line_extent(const Vec3<Real>& s, const Vec3<Real>& p0, const Vec3<Real>& p1, const Vec3<Real>& closest,
                 const Real& distance, const Real& l0, const Real& l1, const Real& length) noexcept {
    LineExtent<Real> e;

    // Set up the plane of the line and the origin (Peters 2021, linear lights, Sec. 3.1).
    const auto passes_by = (distance > Real(kSmallestDistance<scalar_t<Real>>)) & (length > Real(0));
    // If there is no light, any values will do that keep the formulas finite.
    e.distance = select(passes_by, distance, Real(1));
    e.s = s;
    e.t = (Real(1) / e.distance) * closest;
    e.length = length;
    e.l0 = l0;
    e.l1 = l1;

    // Find sines and cosines of the angles of both ends, and their heights.
    const Real r0 = sqrt(fma(l0, l0, e.distance * e.distance));
    const Real r1 = sqrt(fma(l1, l1, e.distance * e.distance));
    const Real inverse_r0 = Real(1) / r0;
    const Real inverse_r1 = Real(1) / r1;
    e.s0 = l0 * inverse_r0;
    e.s1 = l1 * inverse_r1;
    e.c0 = e.distance * inverse_r0;
    e.c1 = e.distance * inverse_r1;
    e.height0 = max(p0.z, Real(0)) / r0;
    e.height1 = max(p1.z, Real(0)) / r1;

    // One plus or minus a sine cancels for one sign of it; the squared cosine does not.
    const Real one_plus_abs0 = Real(1) + abs(e.s0);
    const Real one_plus_abs1 = Real(1) + abs(e.s1);
    e.one_plus_s0 = select(e.s0 < Real(0), e.c0 * e.c0 / one_plus_abs0, one_plus_abs0);
    e.one_minus_s1 = select(e.s1 > Real(0), e.c1 * e.c1 / one_plus_abs1, one_plus_abs1);

    // Points are best found from the nearer end.
    e.starts_near = r0 <= r1;
    e.near = select(e.starts_near, p0, p1);
    e.inward = select(e.starts_near, s, -s);
    e.near_distance = min(r0, r1);
    e.near_cosine = max(e.c0, e.c1);

    // Find the angle between the ends. Its sine is the area of the triangle with the origin, never a difference.
    e.sin_sweep = (length * inverse_r0) * e.c1;
    const Real cos_sweep = fma(e.c0, e.c1, e.s0 * e.s1);
    e.visible = passes_by & (e.sin_sweep > Real(0));
    e.acute = cos_sweep > Real(0);
    e.half_tangent = e.sin_sweep / (Real(1) + abs(cos_sweep));

    // Find the difference of both sines (Eq. 1). Beyond a quarter of a turn the closest point lies between the ends,
    // and they add up.
    e.sine_extent = select(e.acute, e.half_tangent * (e.c0 + e.c1), e.s1 - e.s0);
    return e;
}

template <class Real, class Single>
NUSSELT_INLINE LineExtent<Real> broadcast(const LineExtent<Single>& e) noexcept {
    return {broadcast<Real>(e.s),
            broadcast<Real>(e.t),
            Real(e.distance),
            Real(e.length),
            Real(e.l0),
            Real(e.l1),
            Real(e.s0),
            Real(e.s1),
            Real(e.c0),
            Real(e.c1),
            Real(e.height0),
            Real(e.height1),
            Real(e.one_plus_s0),
            Real(e.one_minus_s1),
            Real(e.sin_sweep),
            Real(e.half_tangent),
            Real(e.sine_extent),
            broadcast<Real>(e.near),
            broadcast<Real>(e.inward),
            Real(e.near_distance),
            Real(e.near_cosine),
            mask_t<Real>(e.starts_near),
            mask_t<Real>(e.acute),
            mask_t<Real>(e.visible)};
}

NUSSELT_NAMESPACE_END
