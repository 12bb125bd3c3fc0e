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

/// A smaller distance of a line from the origin, relative to that of its points, cannot be distinguished from rounding.
template <class Scalar>
inline constexpr Scalar kSmallestDistance = 4 * std::numeric_limits<Scalar>::epsilon();

/// A segment in units in which products of up to four coordinates stay in range.
template <class Real>
struct SafeLine {
    LineSegment<Real> line;
    Real squared_reach; ///< squared distance of the start, plus squared length
    Real scale;         ///< a power of two by which it is larger than the original
    Real inverse_scale;
};

template <class Real>
NUSSELT_INLINE Real squared_reach(const LineSegment<Real>& line) noexcept {
    return multiply_add(line.length, line.length, dot(line.p0, line.p0));
}

/// Scales a segment only if it is very large or very small, so that the ordinary case does not wait for a scale.
template <class Real>
NUSSELT_INLINE SafeLine<Real> to_safe_extent(const LineSegment<Real>& line) noexcept {
    constexpr scalar_t<Real> kLargest = power_of_two<scalar_t<Real>>(24);
    constexpr scalar_t<Real> kSmallest = power_of_two<scalar_t<Real>>(-16);
    SafeLine<Real> safe{line, squared_reach(line), Real(1), Real(1)};
    const auto fits = (safe.squared_reach < Real(kLargest)) & (safe.squared_reach > Real(kSmallest));
    if (!all(fits)) {
        safe.scale = select(fits, Real(1), scale_of(line));
        safe.inverse_scale = reciprocal_power_of_two(safe.scale);
        safe.line = scaled(line, safe.scale);
        safe.squared_reach = squared_reach(safe.line);
    }
    return safe;
}

/// A segment by coordinates along its line; without length if the line meets the origin up to rounding.
template <class Real>
NUSSELT_INLINE CenteredLine<Real> centered(const SafeLine<Real>& safe) noexcept {
    using Scalar = scalar_t<Real>;
    const Vec3<Real>& p0 = safe.line.p0;
    const Vec3<Real>& s = safe.line.s;
    const Real& length = safe.line.length;

    // Subtract the part along the line in two steps, of which the first one rounds the difference only. What it leaves is
    // the error of the scalar product, and of the direction, which is not quite of unit length.
    const Real along = dot(p0, s);
    const Vec3<Real> nearly = fma(-along, s, p0);
    const Real rest = dot(nearly, s);
    const Real squared = multiply_add(-rest, rest, dot(nearly, nearly));
    constexpr Scalar kSmallest = kSmallestDistance<Scalar> * kSmallestDistance<Scalar>;
    const auto passes_by = squared > Real(kSmallest) * safe.squared_reach;

    // Go from the near end to the far one. Either has a distance of 0 from the start. The end points are rounded once:
    // where one is close to the origin, adding the length to its coordinates would turn its direction.
    const Real sign = copysign(Real(1), Real(2) * along + length);
    const Real half = Real(Scalar(0.5)) * length;
    const Real near_offset = half - sign * half;
    const Real far_offset = half + sign * half;
    return {fma(near_offset, s, p0),
            sign * s,
            multiply_add(-rest, s, nearly),
            select(passes_by, squared, Real(1)),
            sign * ((along + near_offset) + rest),
            sign * ((along + far_offset) + rest),
            fma(far_offset, s.z, p0.z),
            select(passes_by, length, Real(0)),
            sign};
}

/// Removes the part with z < 0. The line stays; only an end point moves, to z = 0 exactly.
template <class Real>
NUSSELT_INLINE void clip_to_horizon(CenteredLine<Real>& line) noexcept {
    if (all(min(line.near.z, line.far_z) > Real(kTiny<scalar_t<Real>>))) return;
    // Tell which ends lie above the horizon.
    const Real near_z = without_tiny(line.near.z);
    const Real far_z = without_tiny(line.far_z);
    const auto rises = (near_z < Real(0)) & (far_z > Real(0));
    const auto falls = (near_z > Real(0)) & (far_z < Real(0));
    const auto crosses = rises | falls;
    const auto all_above =
        (near_z >= Real(0)) & (far_z >= Real(0)) & (max(line.near.z, line.far_z) > Real(0));
    line.length = select(crosses | all_above, line.length, Real(0));
    if (!any(crosses)) {
        line.near.z = max(line.near.z, Real(0));
        line.far_z = max(line.far_z, Real(0));
        return;
    }

    // Find the crossing with the horizon.
    const Real slope = select(crosses, line.inward.z, Real(1));
    // The remaining length follows from the end above the horizon: the difference of coordinates would cancel.
    const Real remaining = min(select(rises, far_z, near_z) / abs(slope), line.length);
    // The first formula errs by rounding times the distance over the slope, the second by rounding times the
    // length: the better one gives z = 0 up to rounding also near the axis of the light.
    const Real rise = slope * line.far_l;
    const auto steep = line.squared < rise * rise;
    const Real crossing = select(steep, -line.closest.z / slope,
                                 select(rises, line.far_l - remaining, line.near_l + remaining));
    Vec3<Real> on_horizon = multiply_add(crossing, line.inward, line.closest);
    on_horizon.z = Real(0);

    // Replace the end that lies below. If it was the far one, it may now be the near one.
    const auto swaps = falls & (crossing + line.near_l < Real(0));
    const Real turn = select(swaps, Real(-1), Real(1));
    const Real far_l = select(falls, select(swaps, -line.near_l, crossing), line.far_l);
    line.far_z = select(falls, select(swaps, line.near.z, Real(0)), line.far_z);
    line.near_l = select(rises | swaps, turn * crossing, line.near_l);
    line.far_l = far_l;
    line.near = select(rises | swaps, on_horizon, line.near);
    line.inward = turn * line.inward;
    line.sign = turn * line.sign;
    line.length = select(crosses, remaining, line.length);
    line.near.z = max(line.near.z, Real(0));
    line.far_z = max(line.far_z, Real(0));
}

/// The extent of a whole segment, in any frame.
template <class Real>
NUSSELT_INLINE LineExtent<Real> whole_extent(const SafeLine<Real>& safe) noexcept {
    return make_line_extent(centered(safe));
}

/// The extent of the part of a segment with z > 0, in shading space.
template <class Real>
NUSSELT_INLINE LineExtent<Real> clipped_extent(const SafeLine<Real>& safe) noexcept {
    CenteredLine<Real> line = centered(safe);
    clip_to_horizon(line);
    return make_line_extent(line);
}

/// The integral 2 int cos(alpha) n . w(alpha) d alpha along an extent above the horizon: the projected solid angle per
/// radius times the distance (E of Peters 2021, linear lights, Eq. 2 and 3). It is split in the middle of the angle between
/// the ends, from which angles are at most a quarter of a turn. By the end points, nothing cancels: with the sine and the
/// cosine at the normal relative to the middle, the integral up to a point is
///
///     n_t (theta - sin(theta)) + sine (middle_height + height).
///
/// The first term can only be negative where the second one is larger: no more than a factor of two is lost.
template <class Real>
struct CosineIntegral {
    Real middle_cosine, middle_height; ///< cosines of the middle direction with t and with the normal
    Real from_near, to_far;            ///< as in LinePoint, of the middle
    Real quarter_tangent;              ///< tangent of a quarter of the angle between the ends
    Real bend;                         ///< theta - sin(theta) for half the angle
    Real near, far;                    ///< the integrals between the ends and the middle

    NUSSELT_INLINE explicit CosineIntegral(const LineExtent<Real>& e, const Real& n_t) noexcept {
        // The direction to the middle is the sum of both unit directions, over twice the cosine of half the angle between
        // them.
        const Real root = sqrt(Real(2) * e.product * e.one_plus_cosine);
        const Real inverse = e.product / root;
        const Real near_cosine = e.near_cosine(), far_cosine = e.far_cosine();
        const Real near_height = e.near_height(), far_height = e.far_height();
        middle_cosine = (near_cosine + far_cosine) * inverse;
        middle_height = (near_height + far_height) * inverse;
        quarter_tangent = e.area() / (e.one_plus_cosine + root);
        const auto obtuse = e.is_obtuse();
        if (any(obtuse)) {
            // The sum nearly vanishes, but not the difference of the directions, which is perpendicular to the middle.
            const Real twice = e.product + e.product;
            const Real one_plus_cosine = e.precise_one_plus_cosine();
            const Real difference = sqrt(twice * (twice - one_plus_cosine));
            const Real inverse_difference = e.product / difference;
            const Real cosine = e.sine_extent().difference * inverse_difference;
            const Real sine = (near_cosine - far_cosine) * inverse_difference;
            middle_cosine = select(obtuse, cosine, middle_cosine);
            middle_height = select(obtuse, multiply_add(e.line.inward.z, sine, n_t * cosine), middle_height);
            quarter_tangent =
                select(obtuse, difference / (twice + sqrt(twice * one_plus_cosine)), quarter_tangent);
        }
        from_near = quarter_tangent * (middle_cosine + near_cosine);
        to_far = quarter_tangent * (middle_cosine + far_cosine);
        bend = n_t * angle_minus_sine(quarter_tangent);
        near = max(multiply_add(from_near, middle_height + near_height, bend), Real(0));
        far = max(multiply_add(to_far, middle_height + far_height, bend), Real(0));
    }
};

/// The integral from end to end.
template <class Real>
NUSSELT_INLINE Real cosine_integral(const LineExtent<Real>& e) noexcept {
    const CosineIntegral<Real> halves(e, e.n_t());
    return halves.near + halves.far;
}

/// Solid angle per radius of a linear light in the limit of a thin cylinder [sr/m], in any frame.
template <class Real>
NUSSELT_HD inline Real solid_angle(const LineSegment<Real>& line) noexcept {
    const auto safe = to_safe_extent(line);
    const LineExtent<Real> e = whole_extent(safe);
    return select(e.visible(), Real(2) * e.sine_extent().density * e.distance * safe.scale, Real(0));
}

/// Projected solid angle per radius of the part of a linear light above the horizon in the limit of a thin
/// cylinder [sr/m], in shading space.
template <class Real>
NUSSELT_HD inline Real projected_solid_angle(const LineSegment<Real>& line) noexcept {
    const auto safe = to_safe_extent(line);
    const LineExtent<Real> e = clipped_extent(safe);
    return select(e.visible(), cosine_integral(e) * e.inverse_distance() * safe.scale, Real(0));
}

NUSSELT_NAMESPACE_END
