#pragma once
/// Line segments, and the angles under which a shading point sees them.

#include <nusselt/core/broadcast.h>
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

/// A segment from the end nearer to the origin to the other one, with coordinates along its infinite line that are 0 at
/// the point closest to the origin.
template <class Real>
struct CenteredLine {
    Vec3<Real> near;    ///< end point
    Vec3<Real> inward;  ///< unit direction from there to the far end
    Vec3<Real> closest; ///< the point of the infinite line closest to the origin
    Real squared;       ///< squared distance of that point from the origin, positive
    Real near_l, far_l; ///< coordinates of the end points; far_l is not less than |near_l|
    Real far_z;         ///< of the far end
    Real length;        ///< far_l - near_l, which may be known more accurately; 0 if there is no light
    Real sign;          ///< 1 if the near end is the start, else -1
};

/// The segment between two points of a line.
/// \param s unit direction from p0 to p1.
/// \param closest, squared, length as in CenteredLine.
/// \param l0, l1 coordinates of the points along s.
template <class Real>
NUSSELT_INLINE CenteredLine<Real> line_between(const Vec3<Real>& s, const Vec3<Real>& p0,
                                               const Vec3<Real>& p1, const Vec3<Real>& closest,
                                               const Real& squared, const Real& l0, const Real& l1,
                                               const Real& length) noexcept {
    const auto starts_near = l0 + l1 >= Real(0);
    const Real sign = select(starts_near, Real(1), Real(-1));
    return {select(starts_near, p0, p1),
            sign * s,
            closest,
            squared,
            select(starts_near, l0, -l1),
            select(starts_near, l1, -l0),
            select(starts_near, p1.z, p0.z),
            length,
            sign};
}

/// The angles under which the origin sees a segment. In the half-plane that it spans with the origin, t leads to the point
/// of the infinite line that is closest to the origin, and s from the end of the segment that is nearer to the origin to the
/// other one: a point of the light is distance * (tan(alpha) s + t), its direction sin(alpha) s + cos(alpha) t. Peters 2021
/// (linear lights), Sec. 3.1, in terms of the end points, so that short, distant or nearly aligned segments keep their
/// relative precision. The unit of length is arbitrary.
template <class Real>
struct LineExtent {
    CenteredLine<Real> line;
    Real distance, inverse_distance; ///< of the infinite line from the origin
    Real near_distance, far_distance; ///< of the end points
    Real near_cosine, far_cosine;
    Real one_plus_near_sine, one_minus_far_sine; ///< accurate relative to themselves
    Real near_height, far_height; ///< z of the unit directions to the end points
    Real product;                 ///< of the distances of both ends
    Real area;                    ///< product times the sine of the angle between the ends, at most half a turn
    Real one_plus_cosine;         ///< product times one plus the cosine of that angle

    NUSSELT_HD Real near_sine() const noexcept { return one_plus_near_sine - Real(1); }
    NUSSELT_HD Real far_sine() const noexcept { return Real(1) - one_minus_far_sine; }
    /// Far sine minus near sine, accurate relative to itself (Eq. 1): the tangent of half the angle between the ends times
    /// the sum of the cosines.
    NUSSELT_HD Real sine_extent() const noexcept {
        return area * (near_distance + far_distance) * distance / (product * one_plus_cosine);
    }
    /// False if the segment has no length or its line passes through the origin.
    NUSSELT_HD mask_t<Real> visible() const noexcept { return area > Real(0); }
};

/// The extent of a segment.
template <class Real>
NUSSELT_INLINE LineExtent<Real> make_line_extent(const CenteredLine<Real>& line) noexcept {
    using Scalar = scalar_t<Real>;
    // Find the cosines of the angles of both ends, and their heights.
    const Real d = sqrt(line.squared);
    const Real near_r = sqrt(multiply_add(line.near_l, line.near_l, line.squared));
    const Real far_r = sqrt(multiply_add(line.far_l, line.far_l, line.squared));
    const Real near_sum = near_r + abs(line.near_l);
    const Real far_sum = far_r + line.far_l;
    const Real near_inverse = Real(1) / (near_r * near_sum);
    const Real far_inverse = Real(1) / (far_r * far_sum);
    const Real inverse_near_r = near_inverse * near_sum;
    const Real inverse_far_r = far_inverse * far_sum;
    const Real near_cosine = d * inverse_near_r;
    const Real far_cosine = d * inverse_far_r;

    // One plus or minus a sine cancels for one sign of it. There, it follows from the squared cosine. The far end lies
    // always beyond the closest point.
    const Real one_plus_near =
        multiply_add(line.squared, near_inverse, (line.near_l + abs(line.near_l)) * inverse_near_r);
    const Real one_minus_far = line.squared * far_inverse;

    // Describe the angle between the ends. Its sine is the area of the triangle with the origin, never a difference. One
    // plus its cosine cancels near half a turn, where the sum of the unit vectors to both ends does not.
    const Real product = near_r * far_r;
    const Real cosine = multiply_add(line.near_l, line.far_l, line.squared);
    Real one_plus_cosine = product + cosine;
    const auto is_wide = one_plus_cosine < Real(Scalar(0.5)) * product;
    if (any(is_wide)) {
        const Real sines = one_plus_near - one_minus_far;
        const Real cosines = near_cosine + far_cosine;
        const Real squared = multiply_add(sines, sines, cosines * cosines);
        one_plus_cosine = select(is_wide, Real(Scalar(0.5)) * product * squared, one_plus_cosine);
    }
    // Member by member: as a whole, g++ would copy packs by way of memory.
    return {{line.near, line.inward, line.closest, line.squared, line.near_l, line.far_l, line.far_z, line.length,
             line.sign},
            d,
            Real(1) / d,
            near_r,
            far_r,
            near_cosine,
            far_cosine,
            one_plus_near,
            one_minus_far,
            line.near.z * inverse_near_r,
            line.far_z * inverse_far_r,
            product,
            line.length * d,
            one_plus_cosine};
}

/// A point of a segment, given by sine and cosine of its angle alpha.
template <class Real>
struct LinePoint {
    Real sine, cosine; ///< of alpha
    Real from_near;    ///< sine minus that of the near end, accurate relative to itself
    Real to_far;       ///< sine of the far end minus this one, likewise
};

/// The map from sines of angles to directions and points of a segment.
template <class Real>
struct LineMap {
    /// Uninitialised: to be assigned to before it is used.
    LineMap() = default;

    NUSSELT_INLINE explicit LineMap(const LineExtent<Real>& e) noexcept
        : near(e.line.near),
          inward(e.line.inward),
          closest(e.line.closest),
          inverse_distance(e.inverse_distance),
          length(e.line.length),
          twice_near_distance(Real(2) * e.near_distance),
          near_cosine(e.near_cosine),
          one_plus_near_sine(e.one_plus_near_sine),
          one_minus_far_sine(e.one_minus_far_sine) {}

    /// Broadcasts a map to all lanes of a pack.
    template <class Single>
    NUSSELT_HD explicit LineMap(const LineMap<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param from_near, to_far not negative; they add up to the difference of the sines of both ends.
    NUSSELT_INLINE LinePoint<Real> point_at(const Real& from_near, const Real& to_far) const noexcept {
        // The square of the cosine is (1 + sine) (1 - sine): sums of positive terms.
        const Real one_plus_sine = one_plus_near_sine + from_near;
        return {one_plus_sine - Real(1), sqrt(one_plus_sine * (one_minus_far_sine + to_far)), from_near, to_far};
    }

    /// The point itself, on the segment.
    NUSSELT_INLINE Vec3<Real> position(const LinePoint<Real>& point) const noexcept {
        // The nearer end is the more accurate place to start from. The step is 2 sin(theta / 2) cos(theta / 2)
        // times its distance over the cosine of alpha, with tan(theta / 2) = from_near / sum.
        const Real sum = near_cosine + point.cosine;
        const Real squares = multiply_add(sum, sum, point.from_near * point.from_near);
        const Real step = (twice_near_distance * point.from_near) * sum / (point.cosine * squares);
        const Vec3<Real> p = multiply_add(min(step, length), inward, near);
        // A point much closer to the origin than both ends would suffer from their rounding. It lies far from them.
        const auto beside = point.cosine > Real(2) * near_cosine;
        if (!any(beside)) return p;
        const Real l = point.sine / (point.cosine * inverse_distance);
        return select(beside, multiply_add(l, inward, closest), p);
    }

    /// Unit direction to a point.
    /// \param p its position.
    NUSSELT_INLINE Vec3<Real> direction(const LinePoint<Real>& point, const Vec3<Real>& p) const noexcept {
        // The point is as far away as the closest one over the cosine.
        return (point.cosine * inverse_distance) * p;
    }

    /// The point in a unit direction that hits the segment up to rounding.
    /// \param sine_extent the difference of the sines of both ends.
    NUSSELT_HD LinePoint<Real> point_in(const Vec3<Real>& wi, const Real& sine_extent) const noexcept {
        const Real along = dot(wi, inward);
        const Real across = max(inverse_distance * dot(wi, closest), Real(0));
        // The angle from the end on the same side of the closest point is acute.
        const auto before_closest = along < Real(0);
        const Real far_cosine = sqrt(one_minus_far_sine * (Real(2) - one_minus_far_sine));
        const Real end_sine =
            select(before_closest, one_plus_near_sine - Real(1), Real(1) - one_minus_far_sine);
        const Real end_cosine = select(before_closest, near_cosine, far_cosine);
        const Real turned = difference_of_products(along, end_cosine, across, end_sine);
        const Real sin = max(select(before_closest, turned, -turned), Real(0));
        const Real cos = max(fma(along, end_sine, across * end_cosine), Real(0));
        const Real step = min(sin / (Real(1) + cos) * (end_cosine + across), sine_extent);
        const Real rest = sine_extent - step;
        return {along, across, select(before_closest, step, rest), select(before_closest, rest, step)};
    }

    Vec3<Real> near;       ///< the end nearer to the origin; the start if both are equally far
    Vec3<Real> inward;     ///< s
    Vec3<Real> closest;    ///< the point of the infinite line closest to the origin
    Real inverse_distance; ///< of that point
    Real length;
    Real twice_near_distance; ///< of the near end from the origin
    Real near_cosine;
    Real one_plus_near_sine, one_minus_far_sine;

    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.near, self.inward, self.closest, self.inverse_distance, self.length, self.twice_near_distance,
              self.near_cosine, self.one_plus_near_sine, self.one_minus_far_sine);
    }
};

NUSSELT_NAMESPACE_END
