#pragma once
/// Shadows of triangles of which only a part lies between the point and the plane of the light.
///
/// Like triangle_shadow.h, but each line decides which of the edges that it crosses it meets in front of the point, and
/// before the light.

#include <nusselt/line_samples/triangle_shadow.h>

NUSSELT_NAMESPACE_BEGIN

/// The projection of a triangle that crosses the plane of the light, or the parallel one through the point.
template <class Scalar>
struct PartialShadow {
    static constexpr int kFirst[3] = {0, 1, 0}; ///< corner of an edge
    static constexpr int kSecond[3] = {1, 2, 2};

    /// Offsets [m].
    Scalar corner[3];
    /// Corners behind the point, whose offset is that of the line in the opposite direction.
    bool behind[3];
    ShadowEdge<Scalar> edge[3];
    /// Lines that pass the first corner of the edge on the other side meet it behind.
    bool turn[3];
    /// Offset where the edge reaches the light [m].
    Scalar end_of_edge[3];
    /// Lines with smaller offsets than that meet the edge beyond the light.
    bool beyond_below_end[3];
    /// The edge where the plane of the triangle reaches the light.
    ShadowEdge<Scalar> end;
    /// Whether the point is on the side of the triangle where its corners go clockwise.
    bool faces;
};

/// \param a, b, c as for make_triangle_shadow().
template <class Scalar>
NUSSELT_HD inline PartialShadow<Scalar> make_partial_shadow(const ShadowFrame<Scalar>& frame,
                                                            const Vec3<Scalar>& a, const Vec3<Scalar>& b,
                                                            const Vec3<Scalar>& c) noexcept {
    constexpr Scalar kInfinity = std::numeric_limits<Scalar>::infinity();
    const detail::ShadowCorner<Scalar> corner[] = {
        detail::shadow_corner(frame, a), detail::shadow_corner(frame, b), detail::shadow_corner(frame, c)};
    PartialShadow<Scalar> shadow;
    for (int i = 0; i < 3; ++i) {
        shadow.corner[i] = corner[i].offset;
        shadow.behind[i] = corner[i].position.z < Scalar(0);
    }
    for (int e = 0; e < 3; ++e) {
        const detail::ShadowCorner<Scalar>& p = corner[PartialShadow<Scalar>::kFirst[e]];
        const detail::ShadowCorner<Scalar>& q = corner[PartialShadow<Scalar>::kSecond[e]];
        const Vec3<Scalar> d = q.position - p.position;
        shadow.edge[e] = detail::shadow_edge(frame, p, q);
        if (p.position.z == Scalar(0) && q.position.z == Scalar(0)) {
            // Level with the point: infinitely far on the side where lines cross it.
            const Scalar side = fma(p.position.y, d.x, -(p.position.x * d.y)) * d.x;
            shadow.edge[e] = {copysign(kInfinity, side), Scalar(0)};
        }
        shadow.turn[e] = fma(p.position.z, d.x, -(p.position.x * d.z)) > Scalar(0);
        shadow.beyond_below_end[e] = p.position.z > frame.end;
        shadow.end_of_edge[e] = kInfinity;
        if ((p.position.z > frame.end) != (q.position.z > frame.end)) {
            const Scalar x = fma((frame.end - p.position.z) / d.z, d.x, p.position.x);
            shadow.end_of_edge[e] = frame.unit * x / kShadowEnd<Scalar> - frame.origin.x;
            shadow.beyond_below_end[e] = !(shadow.end_of_edge[e] < (p.position.z > frame.end ? p : q).offset);
        }
    }
    const Vec3<Scalar> n =
        detail::fused_cross(corner[1].position - corner[0].position, corner[2].position - corner[0].position);
    const Scalar height = detail::fused_dot(n, corner[0].position);
    shadow.faces = height > Scalar(0);
    shadow.end = detail::shadow_edge(frame, n, frame.unit * height / kShadowEnd<Scalar>, Scalar(0));
    return shadow;
}

namespace detail {

/// The point where a line meets an edge of an occluder.
template <class Real>
struct ShadowCrossing {
    Real t;
    mask_t<Real> front;  ///< of the point
    mask_t<Real> beyond; ///< the light
};

template <class Real, class Scalar>
NUSSELT_INLINE ShadowCrossing<Real> shadow_crossing(const PartialShadow<Scalar>& shadow, int e,
                                                    const Real& offset,
                                                    const mask_t<Real>& first_is_above) noexcept {
    using Mask = mask_t<Real>;
    const bool p_behind = shadow.behind[shadow.kFirst[e]];
    const bool q_behind = shadow.behind[shadow.kSecond[e]];
    const auto front = p_behind == q_behind ? Mask(!p_behind) : Mask(first_is_above ^ Mask(shadow.turn[e]));
    const auto below_end = offset < Real(shadow.end_of_edge[e]);
    return {fma(Real(shadow.edge[e].slope), offset, Real(shadow.edge[e].at_zero)), front,
            !(below_end ^ Mask(shadow.beyond_below_end[e]))};
}

template <class Mask>
NUSSELT_INLINE Mask select_mask(const Mask& mask, const Mask& a, const Mask& b) noexcept {
    const Mask otherwise = !mask;
    return (mask & a) | (otherwise & b);
}
template <class Real>
NUSSELT_INLINE ShadowCrossing<Real> select_crossing(const mask_t<Real>& mask, const ShadowCrossing<Real>& a,
                                                    const ShadowCrossing<Real>& b) noexcept {
    return {select(mask, a.t, b.t), select_mask(mask, a.front, b.front),
            select_mask(mask, a.beyond, b.beyond)};
}

} // namespace detail

/// The part of a line that is hidden.
/// \tparam Real a line per lane, or scalar.
template <class Real, class Scalar>
NUSSELT_HD inline Interval<Real> hidden_interval(const PartialShadow<Scalar>& shadow,
                                                 const Real& offset) noexcept {
    using Mask = mask_t<Real>;
    // Find the two edges that the line crosses: the plane of point and line has corners above and below.
    Mask above[3];
    for (int i = 0; i < 3; ++i) above[i] = Mask((offset < Real(shadow.corner[i])) ^ Mask(shadow.behind[i]));
    const Mask crosses_ab = above[0] ^ above[1];
    const Mask crosses_ac = above[0] ^ above[2];
    const auto bc = detail::shadow_crossing(shadow, 1, offset, above[1]);
    const auto p =
        detail::select_crossing(crosses_ab, detail::shadow_crossing(shadow, 0, offset, above[0]), bc);
    const auto q =
        detail::select_crossing(crosses_ac, detail::shadow_crossing(shadow, 2, offset, above[0]), bc);

    // With one crossing behind the point, the shadow reaches from the other one to infinity. Where to follows from the side
    // on which the point sees the triangle: large triangles seen edge-on have both crossings at nearly the same t.
    const Mask p_is_lower = p.t < q.t;
    const auto lower = detail::select_crossing(p_is_lower, p, q);
    const auto upper = detail::select_crossing(p_is_lower, q, p);
    const Mask both = p.front & q.front;
    const auto front = detail::select_crossing(p.front, p, q);
    const Mask rises = !((above[0] ^ Mask(shadow.faces)) ^ p.front);
    const Interval<Real> nothing = empty_interval<Real>();
    const Real begin = select(both, lower.t, select(rises, front.t, nothing.end));
    const Real end = select(both, upper.t, select(rises, nothing.begin, front.t));
    const Mask falls = !rises;
    const Mask rises_beyond = rises & front.beyond;
    const Mask falls_beyond = falls & front.beyond;
    const Mask begins_beyond = detail::select_mask(both, lower.beyond, rises_beyond);
    const Mask ends_beyond = detail::select_mask(both, upper.beyond, falls_beyond);

    // End the shadow at the light.
    const Real light = min(max(fma(Real(shadow.end.slope), offset, Real(shadow.end.at_zero)), begin), end);
    const Mask hides = (crosses_ab | crosses_ac) & (p.front | q.front) & !(begins_beyond & ends_beyond);
    return {select(hides, select(begins_beyond, light, begin), nothing.begin),
            select(hides, select(ends_beyond, light, end), nothing.end)};
}

NUSSELT_NAMESPACE_END
