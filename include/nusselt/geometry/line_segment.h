#pragma once
/// Line segments, and the angles under which a shading point sees them.

#include <nusselt/core/frame.h>
#include <nusselt/core/trig.h>

NUSSELT_NAMESPACE_BEGIN

/// A linear light: a cylinder whose radius tends to zero.
template <class Real>
struct LineSegment {
    Vec3<Real> p0; ///< begin [m]
    Vec3<Real> s;  ///< unit direction from begin to end; zero if both ends coincide
    Real length;   ///< [m]
};

/// The segment from begin to end [m].
template <class Real>
NUSSELT_HD inline LineSegment<Real> make_line(const Vec3<Real>& begin, const Vec3<Real>& end) noexcept {
    const Vec3<Real> extent = end - begin;
    return {begin, normalize(extent), length(extent)};
}

/// The segment seen from a shading point: the point becomes the origin, the normal of the frame +z.
/// \tparam Real may be a pack while the segment is scalar: one light, a shading point per lane.
template <class Real, class LightReal>
NUSSELT_HD inline LineSegment<Real> to_shading_space(const LineSegment<LightReal>& world,
                                                     const Vec3<Real>& point,
                                                     const Frame<Real>& frame) noexcept {
    return {frame.to_local(broadcast<Real>(world.p0) - point), frame.to_local(broadcast<Real>(world.s)),
            Real(world.length)};
}

/// A point of a line extent, given by sine and cosine of its angle alpha.
template <class Real>
struct LinePoint {
    Real sine, cosine; ///< of alpha
    Real from_begin;   ///< sine minus that of the begin, accurate relative to itself
    Real to_end;       ///< sine of the end minus this one, likewise
};

/// A segment in the half-plane that it spans with the origin, as angles alpha about the origin: a point of
/// the light is distance * (tan(alpha) s + t), its direction sin(alpha) s + cos(alpha) t. Peters 2021 (linear
/// lights), Sec. 3.1, in terms of the end points, so that short, distant or nearly aligned segments keep their
/// relative precision. The unit of length is arbitrary.
template <class Real>
struct LineExtent {
    Vec3<Real> s, t;   ///< orthonormal; t points from the origin to the closest point of the infinite line
    Vec3<Real> p0, p1; ///< end points
    Real distance;     ///< of the infinite line from the origin
    Real length;
    Real l0, l1;               ///< coordinates of the end points along s, 0 at the closest point
    Real r0, r1;               ///< distances of the end points from the origin
    Real s0, s1, c0, c1;       ///< sines and cosines of the angles of the end points
    Real sin_sweep, cos_sweep; ///< of the angle between the end points, at most half a turn
    Real sine_extent;          ///< s1 - s0, accurate relative to itself
    mask_t<Real> visible;      ///< false if the segment has no length or its line passes through the origin

    /// \param from_begin sine minus s0, in [0, sine_extent]
    NUSSELT_HD LinePoint<Real> point_at(const Real& from_begin) const noexcept {
        const Real to_end = max(sine_extent - from_begin, Real(0));
        // Seen from the end towards which the cosine decreases, its square is a sum of positive terms.
        const Real from_s0 = s0 + from_begin;
        const auto before_closest = from_s0 < Real(0);
        const Real sine = select(before_closest, from_s0, s1 - to_end);
        const Real squared =
            select(before_closest, fma(-from_begin, s0 + sine, c0 * c0), fma(to_end, s1 + sine, c1 * c1));
        return {sine, sqrt(max(squared, Real(0))), from_begin, to_end};
    }

    /// The point itself, on the segment.
    NUSSELT_HD Vec3<Real> position(const LinePoint<Real>& point) const noexcept {
        // The nearer end is the more accurate place to start from. The step is 2 sin(theta / 2) cos(theta / 2)
        // times its distance over the cosine of alpha, with tan(theta / 2) = tangent.
        const auto from_begin = r0 <= r1;
        const Real cosine = select(from_begin, c0, c1);
        const Real tangent = select(from_begin, point.from_begin, point.to_end) / (cosine + point.cosine);
        const Real step =
            Real(2) * distance * tangent / (cosine * point.cosine * fma(tangent, tangent, Real(1)));
        const Real along = min(step, length);
        const Vec3<Real> p = select(from_begin, p0, p1) + select(from_begin, along, -along) * s;
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
        return point.cosine > Real(2) * max(c0, c1);
    }
};

/// 2^(minus 3/8 of the exponent range), for coordinates of order one: in the square of a smaller distance,
/// components would underflow.
template <class Scalar>
inline constexpr Scalar kSmallestDistance = power_of_two<Scalar>(-std::numeric_limits<Scalar>::max_exponent /
                                                                 8 * 3);

/// The part of a segment between two points of its line.
/// \param p0, p1   the points.
/// \param closest  vector to the closest point of the line.
/// \param distance its length.
/// \param l0, l1   coordinates of the points along the line.
/// \param length   l1 - l0, which the caller may know more accurately.
template <class Real>
NUSSELT_HD inline LineExtent<Real>
make_line_extent(const Vec3<Real>& s, const Vec3<Real>& p0, const Vec3<Real>& p1, const Vec3<Real>& closest,
                 const Real& distance, const Real& l0, const Real& l1, const Real& length) noexcept {
    LineExtent<Real> e;
    const auto passes_by = (distance > Real(kSmallestDistance<scalar_t<Real>>)) & (length > Real(0));
    // Without light, any values will do that keep the formulas finite.
    e.distance = select(passes_by, distance, Real(1));
    e.s = s;
    e.t = (Real(1) / e.distance) * closest;
    e.p0 = p0;
    e.p1 = p1;
    e.length = length;
    e.l0 = l0;
    e.l1 = l1;
    e.r0 = sqrt(fma(l0, l0, e.distance * e.distance));
    e.r1 = sqrt(fma(l1, l1, e.distance * e.distance));
    const Real inverse_0 = Real(1) / e.r0;
    const Real inverse_1 = Real(1) / e.r1;
    e.s0 = l0 * inverse_0;
    e.s1 = l1 * inverse_1;
    e.c0 = e.distance * inverse_0;
    e.c1 = e.distance * inverse_1;
    // The sine of the sweep is the area of the triangle with the origin, never a difference.
    e.sin_sweep = (length * inverse_0) * e.c1;
    e.cos_sweep = fma(e.c0, e.c1, e.s0 * e.s1);
    e.visible = passes_by & (e.sin_sweep > Real(0));
    const auto acute = e.cos_sweep > Real(0);
    const Real tangent = select(acute, e.sin_sweep, Real(1) - e.cos_sweep) /
                         select(acute, Real(1) + e.cos_sweep, select(e.visible, e.sin_sweep, Real(1)));
    e.sine_extent = tangent * (e.c0 + e.c1);
    return e;
}

template <class Real, class Single>
NUSSELT_HD inline LineExtent<Real> broadcast(const LineExtent<Single>& e) noexcept {
    return {broadcast<Real>(e.s),
            broadcast<Real>(e.t),
            broadcast<Real>(e.p0),
            broadcast<Real>(e.p1),
            Real(e.distance),
            Real(e.length),
            Real(e.l0),
            Real(e.l1),
            Real(e.r0),
            Real(e.r1),
            Real(e.s0),
            Real(e.s1),
            Real(e.c0),
            Real(e.c1),
            Real(e.sin_sweep),
            Real(e.cos_sweep),
            Real(e.sine_extent),
            mask_t<Real>(e.visible)};
}

NUSSELT_NAMESPACE_END
