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
NUSSELT_INLINE CenteredLine<Real>
line_between(const Vec3<Real>& s, const Vec3<Real>& p0, const Vec3<Real>& p1, const Vec3<Real>& closest,
             const Real& squared, const Real& l0, const Real& l1, const Real& length) noexcept {
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
    Real distance;                  ///< of the infinite line from the origin
    Real near_distance;             ///< of the near end from the origin
    Real near_inverse, far_inverse; ///< reciprocal distances of the ends
    Real near_inverse_squared, far_inverse_squared;
    Real product; ///< of the distances of both ends
    /// The product times one plus the cosine of the angle between the ends, which is at most half a turn. Its error is
    /// relative to the product: see precise_one_plus_cosine().
    Real one_plus_cosine;

    NUSSELT_INLINE Real inverse_distance() const noexcept { return Real(1) / distance; }
    /// Component of the normal along t.
    NUSSELT_INLINE Real n_t() const noexcept { return inverse_distance() * line.closest.z; }
    NUSSELT_INLINE Real near_sine() const noexcept { return line.near_l * near_inverse; }
    NUSSELT_INLINE Real far_sine() const noexcept { return line.far_l * far_inverse; }
    NUSSELT_INLINE Real near_cosine() const noexcept { return distance * near_inverse; }
    NUSSELT_INLINE Real far_cosine() const noexcept { return distance * far_inverse; }
    /// z of the unit directions to the end points.
    NUSSELT_INLINE Real near_height() const noexcept { return line.near.z * near_inverse; }
    /// \copydoc near_height
    NUSSELT_INLINE Real far_height() const noexcept { return line.far_z * far_inverse; }
    /// The product times the sine of the angle between the ends: twice the area of the triangle with the origin.
    NUSSELT_INLINE Real area() const noexcept { return line.length * distance; }
    struct SineExtent {
        Real difference; ///< far sine minus near sine, accurate relative to itself
        Real density;    ///< the same over the squared distance of the line
    };
    NUSSELT_INLINE SineExtent sine_extent() const noexcept {
        const SineRatio ratio = sine_ratio();
        const Real density = ratio.numerator / ratio.denominator;
        return {select(line.near_l < Real(0), ratio.numerator, line.squared * density), density};
    }
    /// The density of SineExtent as a ratio, whose reciprocal does not wait for it.
    struct SineRatio {
        Real numerator;   ///< 0 without light
        Real denominator; ///< positive
    };
    NUSSELT_INLINE SineRatio sine_ratio() const noexcept {
        // The tangent of half the angle between the ends times the sum of the cosines (Eq. 1) does not cancel. If the closest
        // point lies between the ends, nor do the sines.
        const auto surrounds = line.near_l < Real(0);
        return {select(surrounds & (line.length > Real(0)), far_sine() - near_sine(),
                       line.length * (near_inverse + far_inverse)),
                select(surrounds, line.squared, one_plus_cosine)};
    }
    /// Whether there is light and the angle between its ends exceeds a quarter of a turn.
    NUSSELT_INLINE mask_t<Real> is_obtuse() const noexcept {
        return (one_plus_cosine < product) & (line.length > Real(0));
    }
    /// one_plus_cosine if is_obtuse(), accurate relative to itself: the closest point lies between the ends.
    NUSSELT_INLINE Real precise_one_plus_cosine() const noexcept {
        const Real squares =
            multiply_add(line.near_l, line.near_l, multiply_add(line.far_l, line.far_l, line.squared));
        const Real sum = multiply_add(-line.near_l, line.far_l, product);
        return line.squared * (Real(1) + squares / sum);
    }
    /// False if the segment has no length or its line passes through the origin.
    NUSSELT_INLINE mask_t<Real> visible() const noexcept { return area() > Real(0); }
};

/// The extent of a segment.
template <class Real>
NUSSELT_INLINE LineExtent<Real> make_line_extent(const CenteredLine<Real>& line) noexcept {
    const Real near_squared = multiply_add(line.near_l, line.near_l, line.squared);
    const Real far_squared = multiply_add(line.far_l, line.far_l, line.squared);
    const Real near_inverse_squared = Real(1) / near_squared;
    const Real far_inverse_squared = Real(1) / far_squared;
    const Real near_distance = sqrt(near_squared);
    const Real far_distance = sqrt(far_squared);
    const Real product = near_distance * far_distance;
    // Member by member: as a whole, g++ would copy packs by way of memory.
    return {{line.near, line.inward, line.closest, line.squared, line.near_l, line.far_l, line.far_z,
             line.length, line.sign},
            sqrt(line.squared),
            near_distance,
            near_distance * near_inverse_squared,
            far_distance * far_inverse_squared,
            near_inverse_squared,
            far_inverse_squared,
            product,
            product + multiply_add(line.near_l, line.far_l, line.squared)};
}

/// A point of a segment.
template <class Real>
struct LinePoint {
    Real
        share; ///< sine of its angle minus that of the near end, over that of the far end minus that of the near end
    Real inverse_distance; ///< reciprocal distance from the origin
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
          length(e.line.length),
          near_inverse(e.near_inverse),
          near_inverse_squared(e.near_inverse_squared),
          far_inverse_squared(e.far_inverse_squared),
          near_sine(e.near_sine()) {
        const auto sines = e.sine_extent();
        sine_extent = sines.difference;
        squared_density = sine_extent * sines.density;
        step_scale = Real(2) * e.near_distance * sines.density;
    }

    /// Broadcasts a map to all lanes of a pack.
    template <class Single>
    NUSSELT_HD explicit LineMap(const LineMap<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param share in [0, 1], see LinePoint.
    NUSSELT_INLINE LinePoint<Real> point_at(const Real& share) const noexcept {
        // With sines (1 - x) s0 + x s1, the squared cosines are (1 - x) c0^2 + x c1^2 + x (1 - x) (s1 - s0)^2: a sum of
        // positive terms. Here it is divided by the squared distance of the line.
        const Real rest = Real(1) - share;
        const Real near_part = multiply_add(share, squared_density, near_inverse_squared);
        return {share, sqrt(multiply_add(share, far_inverse_squared, rest * near_part))};
    }

    NUSSELT_INLINE Real sine_at(const Real& share) const noexcept {
        return multiply_add(share, sine_extent, near_sine);
    }

    /// The point itself, on the segment.
    NUSSELT_INLINE Vec3<Real> position(const LinePoint<Real>& point) const noexcept {
        // The nearer end is the more accurate place to start from. With the tangent T of half the angle between that end and
        // the point, the step is 2 T / (1 + T^2) times the distance of the end over the cosine of alpha.
        const Real sum = near_inverse + point.inverse_distance;
        const Real squares = multiply_add(sum, sum, point.share * point.share * squared_density);
        const Real step = (step_scale * point.share) * sum / (point.inverse_distance * squares);
        const Vec3<Real> p = multiply_add(min(step, length), inward, near);
        // A point much closer to the origin than both ends would suffer from their rounding. It lies far from them.
        const auto beside = point.inverse_distance > Real(2) * near_inverse;
        if (!any(beside)) return p;
        const Real l = sine_at(point.share) / point.inverse_distance;
        return select(beside, multiply_add(l, inward, closest), p);
    }

    /// Unit direction to a point.
    /// \param p its position.
    NUSSELT_INLINE Vec3<Real> direction(const LinePoint<Real>& point, const Vec3<Real>& p) const noexcept {
        return point.inverse_distance * p;
    }

    /// The share of the point in a unit direction that hits the segment up to rounding, in [0, 1].
    NUSSELT_HD Real share_in(const Vec3<Real>& wi) const noexcept {
        const Real distance = sqrt(dot(closest, closest));
        const auto apart = distance > Real(0);
        const Real along = dot(wi, inward);
        const Real across = max(dot(wi, closest) / select(apart, distance, Real(1)), Real(0));
        // The angle from the end on the same side of the closest point is acute.
        const auto before_closest = along < Real(0);
        const Real end_sine = select(before_closest, near_sine, near_sine + sine_extent);
        const Real end_cosine = distance * select(before_closest, near_inverse, sqrt(far_inverse_squared));
        const Real turned = difference_of_products(along, end_cosine, across, end_sine);
        const Real sin = max(select(before_closest, turned, -turned), Real(0));
        const Real cos = max(fma(along, end_sine, across * end_cosine), Real(0));
        const Real sines = sin / (Real(1) + cos) * (end_cosine + across);
        const Real share = min(sines / select(sine_extent > Real(0), sine_extent, Real(1)), Real(1));
        return select(before_closest, share, Real(1) - share);
    }

    Vec3<Real> near;    ///< the end nearer to the origin
    Vec3<Real> inward;  ///< s
    Vec3<Real> closest; ///< the point of the infinite line closest to the origin
    Real length;
    Real near_inverse; ///< reciprocal distance of the near end
    Real near_inverse_squared, far_inverse_squared;
    Real near_sine, sine_extent; ///< far sine minus near sine, accurate relative to itself
    Real squared_density;        ///< of sine_extent over the distance of the line
    Real step_scale;

    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.near, self.inward, self.closest, self.length, self.near_inverse, self.near_inverse_squared,
              self.far_inverse_squared, self.near_sine, self.sine_extent, self.squared_density,
              self.step_scale);
    }
};

NUSSELT_NAMESPACE_END
