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

/// A point of a line extent, at the angle theta from its begin.
template <class Real>
struct LinePoint {
    Real sin, cos, tan_half; ///< sine and cosine of theta, tangent of theta / 2
    Real begin, end; ///< nonnegative weights: the unit direction is begin * d0 + end * d1; not if wide
    Real s, c;       ///< components of the unit direction along s and t
};

/// A segment in the half-plane that it spans with the origin, as angles alpha about the origin: a point of
/// the light is distance * (tan(alpha) s + t), its direction sin(alpha) s + cos(alpha) t, with 0 <= theta =
/// alpha - alpha_0 <= sweep. Peters 2021 (linear lights), Sec. 3.1, in terms of the end points, so that
/// short, distant or nearly aligned segments keep their relative precision. The unit of length is arbitrary.
template <class Real>
struct LineExtent {
    Vec3<Real> s, t;     ///< orthonormal; t points from the origin to the closest point of the infinite line
    Vec3<Real> d0, d1;   ///< unit directions to the end points
    Real distance;       ///< of the infinite line from the origin
    Real l0, l1;         ///< coordinates of the end points along s, 0 at the closest point
    Real s0, s1, c0, c1; ///< sines and cosines of the angles of the end points
    Real sweep;          ///< angle between the end points, in [0, pi]
    Real sin_sweep;
    Real tan_half_sweep;
    mask_t<Real> visible; ///< false if the segment has no length or its line passes through the origin

    /// Sine of the angle from the origin to a point minus that of the begin: half the solid angle per radius
    /// between them, times the distance. A product of nonnegative factors.
    NUSSELT_HD Real sine_from_begin(const LinePoint<Real>& point) const noexcept {
        return point.tan_half * (c0 + point.c);
    }

    /// The same for the whole segment.
    NUSSELT_HD Real sine_extent() const noexcept { return tan_half_sweep * (c0 + c1); }

    /// Tangent of theta / 2 for the point where sine_from_begin() is the given fraction of the whole. The
    /// root is nonnegative and in Blinn's stable form.
    NUSSELT_HD Real tan_half_at_fraction(const Real& fraction) const noexcept {
        const Real k = fraction * sine_extent();
        const Real denominator = c0 + sqrt(max(fma(c0, c0, -k * fma(Real(2), s0, k)), Real(0)));
        return min(k / select(denominator > Real(0), denominator, Real(1)), tan_half_sweep);
    }

    /// \param tan_half tangent of theta / 2, at most that of the sweep.
    NUSSELT_HD LinePoint<Real> point_at(const Real& tan_half) const noexcept {
        const Real inverse = Real(1) / fma(tan_half, tan_half, Real(1));
        return point_at(Real(2) * tan_half * inverse, (Real(1) - tan_half) * (Real(1) + tan_half) * inverse,
                        tan_half);
    }

    NUSSELT_HD LinePoint<Real> point_at(const Real& sin, const Real& cos,
                                        const Real& tan_half) const noexcept {
        LinePoint<Real> point{sin, cos, tan_half, Real(0), Real(0), fma(s0, cos, c0 * sin), Real(0)};
        // sin(sweep - theta) / sin(sweep); the cotangent comes from the half angle, which does not cancel.
        const Real cot_sweep = Real(0.5) * (Real(1) - tan_half_sweep) * (Real(1) + tan_half_sweep) /
                               select(visible, tan_half_sweep, Real(1));
        point.begin = max(fma(-cot_sweep, sin, cos), Real(0));
        point.end = sin / select(visible, sin_sweep, Real(1));
        point.c = interpolate(point, c0, c1, -s0);
        return point;
    }

    /// Value at a point of a function A cos(theta) + B sin(theta), given its values at begin and end, which
    /// must be nonnegative, and B. Interpolation has no cancellation but fails near half a turn.
    NUSSELT_HD Real interpolate(const LinePoint<Real>& point, const Real& at_begin, const Real& at_end,
                                const Real& slope) const noexcept {
        return select(wide(), max(fma(at_begin, point.cos, slope * point.sin), Real(0)),
                      fma(point.begin, at_begin, point.end * at_end));
    }

    /// Unit direction to a point.
    NUSSELT_HD Vec3<Real> direction(const LinePoint<Real>& point) const noexcept {
        return select(wide(), point.s * s + point.c * t, point.begin * d0 + point.end * d1);
    }

    /// The point itself: its coordinate along s is distance * tan(alpha), within the segment.
    NUSSELT_HD Vec3<Real> position(const LinePoint<Real>& point) const noexcept {
        const Real along = distance * point.s / select(point.c > Real(0), point.c, Real(1));
        return min(max(along, l0), l1) * s + distance * t;
    }

    /// The point in a unit direction that hits the segment up to rounding.
    NUSSELT_HD LinePoint<Real> point_in(const Vec3<Real>& wi) const noexcept {
        const Real along = dot(wi, s);
        const Real across = dot(wi, t);
        const Real sin = max(difference_of_products(along, c0, across, s0), Real(0));
        const Real cos = fma(along, s0, across * c0);
        const Real tangent = sin / select(cos > Real(-1), Real(1) + cos, Real(1));
        return point_at(sin, cos, min(tangent, tan_half_sweep));
    }

    NUSSELT_HD mask_t<Real> wide() const noexcept { return sweep > Real(2); }
};

/// 2^(a quarter of the exponent range), the cap of tangents of half angles.
template <class Scalar>
inline constexpr Scalar kLargestTangent = [] {
    Scalar result = 1;
    for (int i = 0; i < std::numeric_limits<Scalar>::max_exponent / 4; ++i) result *= 2;
    return result;
}();

/// 2^(minus half of the exponent range), for coordinates of order one: the square of a smaller distance would
/// underflow.
template <class Scalar>
inline constexpr Scalar kSmallestDistance = [] {
    Scalar result = 1;
    for (int i = 0; i < std::numeric_limits<Scalar>::max_exponent / 2 - 4; ++i) result /= 2;
    return result;
}();

/// The part of a segment between the coordinates l0 and l1 along its line.
/// \param distance of the line from the origin; closest is the vector to its closest point.
/// \param length   l1 - l0, which the caller may know more accurately.
template <class Real>
NUSSELT_HD inline LineExtent<Real> make_line_extent(const Vec3<Real>& s, const Vec3<Real>& closest,
                                                    const Real& distance, const Real& l0, const Real& l1,
                                                    const Real& length) noexcept {
    LineExtent<Real> e;
    e.visible = (distance > Real(kSmallestDistance<scalar_t<Real>>)) & (length > Real(0));
    e.s = s;
    e.t = (Real(1) / select(e.visible, distance, Real(1))) * closest;
    e.distance = distance;
    e.l0 = l0;
    e.l1 = l1;
    const Real inverse_0 = Real(1) / select(e.visible, sqrt(fma(l0, l0, distance * distance)), Real(1));
    const Real inverse_1 = Real(1) / select(e.visible, sqrt(fma(l1, l1, distance * distance)), Real(1));
    e.s0 = l0 * inverse_0;
    e.s1 = l1 * inverse_1;
    e.c0 = distance * inverse_0;
    e.c1 = distance * inverse_1;
    e.d0 = e.s0 * e.s + e.c0 * e.t;
    e.d1 = e.s1 * e.s + e.c1 * e.t;
    // The sine of the sweep is the area of the triangle with the origin, never a difference.
    e.sin_sweep = (length * inverse_0) * (distance * inverse_1);
    const Real cosine = fma(e.c0, e.c1, e.s0 * e.s1);
    e.sweep = atan2_positive(e.sin_sweep, cosine);
    e.visible = e.visible & (e.sin_sweep > Real(0));
    const auto acute = cosine > Real(0);
    const Real tangent = select(acute, e.sin_sweep, Real(1) - cosine) /
                         select(acute, Real(1) + cosine, select(e.visible, e.sin_sweep, Real(1)));
    // Its square must not overflow; the angle is then half a turn to any precision.
    e.tan_half_sweep = min(tangent, Real(kLargestTangent<scalar_t<Real>>));
    return e;
}

template <class Real, class Single>
NUSSELT_HD inline LineExtent<Real> broadcast(const LineExtent<Single>& e) noexcept {
    return {broadcast<Real>(e.s),
            broadcast<Real>(e.t),
            broadcast<Real>(e.d0),
            broadcast<Real>(e.d1),
            Real(e.distance),
            Real(e.l0),
            Real(e.l1),
            Real(e.s0),
            Real(e.s1),
            Real(e.c0),
            Real(e.c1),
            Real(e.sweep),
            Real(e.sin_sweep),
            Real(e.tan_half_sweep),
            mask_t<Real>(e.visible)};
}

NUSSELT_NAMESPACE_END
