#pragma once
/// The parts of the lines of a family that one triangle hides from a point.
///
/// Billen and Dutre 2016, Line Sampling for Direct Illumination, Sec. 5.2. Deviations: triangles are projected from the
/// point to the plane of the light, where each edge becomes a line: the coordinate where it crosses a line of the family
/// is a linear function of the offset. Whether a line passes a corner on the left or on the right is one comparison with
/// the offset of the corner. Both are the same, bit by bit, for all triangles that share the edge or corner, so that what
/// the triangles of a mesh hide is connected: nothing shines through closed meshes, also not at corners.

#include <nusselt/line_samples/line_family.h>

NUSSELT_NAMESPACE_BEGIN

/// Share of the way to the light on which occluders count, for lines as for shadow rays: only then both have the same
/// mean. It must end before the light, which is in the scene itself: single precision puts points of it, and the triangles
/// around it, up to some 1e-6 of the way off. Occluders within the last 1e-4 of the way are missed.
template <class Scalar>
inline constexpr Scalar kShadowEnd = Scalar(1) - Scalar(1e-4);

/// The lines of a family as a point sees them, for their shadows.
template <class Real>
struct ShadowFrame {
    Vec3<Real> point;                 ///< the apex of all shadows, in the space of the plane [m]
    Vec3<Real> across, along, normal; ///< as LinePlane, in 1 / unit; the normal points away from the point
    Vec3<Real> origin; ///< of the plane relative to the point, its coordinates along these three vectors [m]
    Real end;          ///< distance of the last occluders from the point, along the normal [unit]
    Real unit; ///< of coordinates of occluders [m], a power of two, so that their products do not overflow
};

/// \param plane in any space.
/// \param point in that space [m].
template <class Real>
NUSSELT_HD inline ShadowFrame<Real> make_shadow_frame(const LinePlane<Real>& plane,
                                                      const Vec3<Real>& point) noexcept {
    const Vec3<Real> to_origin = plane.origin - point;
    const Real distance = dot(to_origin, plane.normal);
    const Real inverse_unit =
        reciprocal_power_of_two(max(max(abs(to_origin.x), abs(to_origin.y)), abs(to_origin.z)));
    const Real side = copysign(inverse_unit, distance);
    return {point,
            inverse_unit * plane.across,
            inverse_unit * plane.along,
            side * plane.normal,
            {dot(to_origin, plane.across), dot(to_origin, plane.along), abs(distance)},
            Real(kShadowEnd<scalar_t<Real>>) * abs(distance) * inverse_unit,
            Real(1) / inverse_unit};
}

/// The same frame in all lanes.
template <class Real, class Single>
NUSSELT_HD inline ShadowFrame<Real> broadcast(const ShadowFrame<Single>& frame) noexcept {
    return {broadcast<Real>(frame.point),
            broadcast<Real>(frame.across),
            broadcast<Real>(frame.along),
            broadcast<Real>(frame.normal),
            broadcast<Real>(frame.origin),
            Real(frame.end),
            Real(frame.unit)};
}

/// A rectangle of the plane of a light.
template <class Real>
struct LineBounds {
    Interval<Real> offsets; ///< [m], both ends included
    Interval<Real> extent;  ///< coordinates along the lines [m]
};

/// The projection of an edge: the coordinate along the line of an offset is at_zero + slope * offset.
template <class Real>
struct ShadowEdge {
    Real at_zero; ///< [m]
    Real slope;
    NUSSELT_HD Real at(const Real& offset) const noexcept { return fma(slope, offset, at_zero); }
};

/// The projection of a triangle that lies between the point and the plane of the light: on lines with an offset in
/// [first, last) it hides what is between `through`, which leads from the first to the last corner, and the other two edges.
/// \tparam Real a triangle per lane, or scalar.
template <class Real>
struct TriangleShadow {
    Real first, middle, last; ///< offsets of the corners [m]; first > last if nothing is hidden
    ShadowEdge<Real> through;
    ShadowEdge<Real> before, after; ///< the middle corner

    /// Lines of which something is hidden.
    NUSSELT_HD mask_t<Real> crosses(const Real& offset) const noexcept {
        return (first <= offset) & (offset < last);
    }
};

/// A shadow in all lanes, for many lines.
template <class Real, class Single>
NUSSELT_HD inline TriangleShadow<Real> broadcast(const TriangleShadow<Single>& shadow) noexcept {
    const auto edge = [](const ShadowEdge<Single>& e) {
        return ShadowEdge<Real>{Real(e.at_zero), Real(e.slope)};
    };
    return {Real(shadow.first),   Real(shadow.middle), Real(shadow.last),
            edge(shadow.through), edge(shadow.before), edge(shadow.after)};
}

/// The part of a line that is hidden.
/// \tparam Real lanes may be lines, triangles or both.
template <class Real>
NUSSELT_HD inline Interval<Real> hidden_interval(const TriangleShadow<Real>& shadow,
                                                 const Real& offset) noexcept {
    const Real a = shadow.through.at(offset);
    const Real b = select(offset < shadow.middle, shadow.before.at(offset), shadow.after.at(offset));
    const auto crosses = shadow.crosses(offset);
    const Interval<Real> nothing = empty_interval<Real>();
    return {select(crosses, min(a, b), nothing.begin), select(crosses, max(a, b), nothing.end)};
}

/// Whether anything in the rectangle may be hidden; never misses a line of it.
template <class Real>
NUSSELT_HD inline mask_t<Real> may_hide(const TriangleShadow<Real>& shadow,
                                        const LineBounds<Real>& bounds) noexcept {
    // Restrict the shadow to the offsets of the rectangle.
    const Real begin = max(shadow.first, bounds.offsets.begin);
    const Real end = min(shadow.last, bounds.offsets.end);
    // fma is monotonic: what an edge has in between lies between these two, bit by bit.
    const auto range = [](const ShadowEdge<Real>& edge, const Real& from, const Real& to) {
        const Real a = edge.at(from);
        const Real b = edge.at(to);
        return Interval<Real>{min(a, b), max(a, b)};
    };
    const Interval<Real> through = range(shadow.through, begin, end);
    const Interval<Real> before = range(shadow.before, begin, min(end, shadow.middle));
    const Interval<Real> after = range(shadow.after, max(begin, shadow.middle), end);

    // Compare the coordinates that all edges cover with those of the rectangle.
    const auto has_before = begin < shadow.middle;
    const auto has_after = shadow.middle <= end;
    const Real lowest = min(through.begin, min(select(has_before, before.begin, through.begin),
                                               select(has_after, after.begin, through.begin)));
    const Real highest = max(through.end, max(select(has_before, before.end, through.end),
                                              select(has_after, after.end, through.end)));
    return (begin <= end) & (lowest < bounds.extent.end) & (highest > bounds.extent.begin);
}

namespace detail {

/// A corner of an occluder.
template <class Real>
struct ShadowCorner {
    Vec3<Real> position; ///< relative to the point, in the axes of the frame [unit]
    Real offset, t;      ///< where the line through the point and the corner meets the plane of the light [m]
};

// Products and sums are written as fma: a compiler that contracts some of them could make different bits of one edge.
template <class Real>
NUSSELT_INLINE Real fused_dot(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
template <class Real>
NUSSELT_INLINE Vec3<Real> fused_cross(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    return {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
}

template <class Real>
NUSSELT_INLINE ShadowCorner<Real> shadow_corner(const ShadowFrame<Real>& frame,
                                                const Vec3<Real>& world) noexcept {
    const Vec3<Real> d = world - frame.point;
    // Plus 0: no corner has -0, whose reciprocal is on the other side.
    const Vec3<Real> p{fused_dot(d, frame.across), fused_dot(d, frame.along),
                       fused_dot(d, frame.normal) + Real(0)};
    const Real inverse = Real(1) / p.z;
    return {p, fma(p.x, frame.origin.z, -(p.z * frame.origin.x)) * inverse,
            fma(p.y, frame.origin.z, -(p.z * frame.origin.y)) * inverse};
}

/// The intersection of a plane through the point with the plane of the light: m.(origin + offset across + t along) =
/// constant.
/// \param otherwise t where the plane has all of a line, or nearly so.
template <class Real>
NUSSELT_INLINE ShadowEdge<Real> shadow_edge(const ShadowFrame<Real>& frame, const Vec3<Real>& m,
                                            const Real& constant, const Real& otherwise) noexcept {
    // Steeper edges end at t of their first corner: their offsets differ by 2^-20 of their length at most, which is about
    // what rounding does to them, and so is what such an edge hides of the lines in between.
    constexpr scalar_t<Real> kSteepest = power_of_two<scalar_t<Real>>(20);
    const auto usable = abs(m.x) < Real(kSteepest) * abs(m.y);
    const Real inverse = Real(-1) / select(usable, m.y, Real(1));
    const Real at_origin = fused_dot(m, frame.origin) - constant;
    return {select(usable, at_origin * inverse, otherwise), select(usable, m.x * inverse, Real(0))};
}
template <class Real>
NUSSELT_INLINE ShadowEdge<Real> shadow_edge(const ShadowFrame<Real>& frame, const ShadowCorner<Real>& a,
                                            const ShadowCorner<Real>& b) noexcept {
    return shadow_edge(frame, fused_cross(a.position, b.position - a.position), Real(0), a.t);
}

template <class Real>
NUSSELT_INLINE ShadowEdge<Real> select_edge(const mask_t<Real>& mask, const ShadowEdge<Real>& a,
                                            const ShadowEdge<Real>& b) noexcept {
    return {select(mask, a.at_zero, b.at_zero), select(mask, a.slope, b.slope)};
}

} // namespace detail

/// Shadows of triangles, and which of them have to be made by make_partial_shadow() instead.
template <class Real>
struct TriangleShadows {
    TriangleShadow<Real> shadow; ///< nothing where partial
    /// Triangles that cross the plane of the light, or the parallel one through the point.
    mask_t<Real> partial;
};

/// \param a, b, c corners in the space of the frame, ordered by their position there (such as lexicographically) and not
///                by winding: each edge is then the same for both of its triangles.
/// \tparam Real a triangle per lane, or scalar: all give the same bits.
template <class Real>
NUSSELT_HD inline TriangleShadows<Real> make_triangle_shadow(const ShadowFrame<Real>& frame,
                                                             const Vec3<Real>& a, const Vec3<Real>& b,
                                                             const Vec3<Real>& c) noexcept {
    // Project the corners and edges to the plane of the light.
    const detail::ShadowCorner<Real> corner[] = {
        detail::shadow_corner(frame, a), detail::shadow_corner(frame, b), detail::shadow_corner(frame, c)};
    const ShadowEdge<Real> ab = detail::shadow_edge(frame, corner[0], corner[1]);
    const ShadowEdge<Real> bc = detail::shadow_edge(frame, corner[1], corner[2]);
    const ShadowEdge<Real> ac = detail::shadow_edge(frame, corner[0], corner[2]);

    // Only triangles wholly between the point and the light have a shadow of this kind.
    const Real nearest = min(min(corner[0].position.z, corner[1].position.z), corner[2].position.z);
    const Real farthest = max(max(corner[0].position.z, corner[1].position.z), corner[2].position.z);
    const auto whole = (nearest > Real(0)) & (farthest <= frame.end);
    const auto nothing = (farthest <= Real(0)) | (nearest > frame.end);

    // Order the corners by offset: the middle one is between the others.
    const Real u[] = {corner[0].offset, corner[1].offset, corner[2].offset};
    const auto a_before_b = u[0] < u[1];
    const auto b_before_c = u[1] < u[2];
    const auto a_before_c = u[0] < u[2];
    const auto a_is_middle = a_before_b ^ a_before_c;
    const auto c_is_middle = a_before_c ^ b_before_c;

    // Choose the edge through both ends and the two at the middle corner.
    const Interval<Real> none = empty_interval<Real>();
    return {{select(whole, min(min(u[0], u[1]), u[2]), none.begin),
             select(a_is_middle, u[0], select(c_is_middle, u[2], u[1])),
             select(whole, max(max(u[0], u[1]), u[2]), none.end),
             detail::select_edge(a_is_middle, bc, detail::select_edge(c_is_middle, ab, ac)),
             detail::select_edge(a_is_middle, detail::select_edge(b_before_c, ab, ac),
                                 detail::select_edge(c_is_middle, detail::select_edge(a_before_b, ac, bc),
                                                     detail::select_edge(a_before_c, ab, bc))),
             detail::select_edge(a_is_middle, detail::select_edge(b_before_c, ac, ab),
                                 detail::select_edge(c_is_middle, detail::select_edge(a_before_b, bc, ac),
                                                     detail::select_edge(a_before_c, bc, ab)))},
            !(whole | nothing)};
}

NUSSELT_NAMESPACE_END
