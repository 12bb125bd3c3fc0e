#pragma once
/// Solid cylinders, and the rectangles that half-planes through a shading point cut out of them.

#include <nusselt/geometry/clip_line.h>

NUSSELT_NAMESPACE_BEGIN

/// A tubular light of finite radius: a cylinder that is closed by flat caps and emits outwards, also from its caps. A
/// point inside receives no light.
template <class Real>
struct Cylinder {
    LineSegment<Real> axis; ///< from the middle of one cap to that of the other
    Real radius;            ///< [m]
};

/// The cylinder seen from a shading point: the point becomes the origin, the normal of the frame +z.
/// \tparam Real may be a pack while the cylinder is scalar: one light, a shading point per lane.
template <class Real, class LightReal>
NUSSELT_INLINE Cylinder<Real> to_shading_space(const Cylinder<LightReal>& world, const Vec3<Real>& point,
                                               const Frame<Real>& frame) noexcept {
    return {to_shading_space(world.axis, point, frame), Real(world.radius)};
}

/// Power of two that brings the coordinates of a cylinder to order one, so that their squares stay in range.
template <class Real>
NUSSELT_INLINE Real scale_of(const Cylinder<Real>& cylinder) noexcept {
    const Vec3<Real>& p0 = cylinder.axis.p0;
    return reciprocal_power_of_two(
        max(max(max(abs(p0.x), abs(p0.y)), abs(p0.z)), max(cylinder.axis.length, cylinder.radius)));
}

/// The same cylinder in all lanes.
template <class Real, class Single>
NUSSELT_INLINE Cylinder<Real> broadcast(const Cylinder<Single>& c) noexcept {
    return {broadcast<Real>(c.axis), Real(c.radius)};
}

template <class Real>
NUSSELT_INLINE Cylinder<Real> scaled(const Cylinder<Real>& cylinder, const Real& scale) noexcept {
    return {scaled(cylinder.axis, scale), scale * cylinder.radius};
}

/// The intersection of the half-plane of points l s + rho t, rho >= 0, through the origin with an infinite cylinder of
/// axis direction s: the strip of rho in [near, far].
template <class Real>
struct CylinderSlice {
    Vec2<Real> azimuth; ///< t in the basis m, n of the view
    Vec3<Real> t;       ///< unit, perpendicular to the axis
    Real offset;        ///< of the half-plane from the axis, to the left of t if s points to the eye
    Real half_chord;    ///< half the width of the strip outside the cylinder
    Real along;         ///< middle of the strip, rho of the axis
    Real near, far;     ///< near is 0 inside the infinite cylinder
    mask_t<Real> meets; ///< false if the half-plane misses the cylinder; it then touches it
};

/// A cylinder as the origin sees it. Lengths are those of the cylinder, which shall have coordinates of order one
/// (scaled()).
template <class Real>
struct CylinderView {
    Vec3<Real> s, m, n; ///< right-handed, orthonormal; s is the direction of the axis
    Vec2<Real> center;  ///< where the infinite axis passes, in the basis m, n
    Real radius;
    Real gap, sum;         ///< distance from the axis minus and plus the radius
    Vec3<Real> start, end; ///< of the axis
    Real l0, l1, length;   ///< coordinates of start and end along s, and their difference
    Vec2<Real> touching;   ///< unit, from outside: the half-plane that touches on the side of n
    Real cotangent;        ///< of its angle from m; 0 from inside
    mask_t<Real> outside;  ///< of the infinite cylinder; m then leads to its axis
    mask_t<Real>
        visible; ///< false inside, on the surface next to it, and for a cylinder without length or radius

    /// The half-plane in a direction, or the closest one that touches the cylinder if that one misses it.
    /// \param direction unit, in the basis m, n.
    /// \param margin    from outside: half-planes this close to one that touches the cylinder count as touching it. The sine of
    ///                  the angle between both, over that of the angle between the touching one and m.
    NUSSELT_HD CylinderSlice<Real> slice(const Vec2<Real>& direction, const Real& margin) const noexcept {
        CylinderSlice<Real> c;

        // Turn directions that miss the cylinder to the closest one that touches it. From outside, the sines of the angles
        // from both half-planes that touch it tell, here over the sine of the angle from there to m: a direction whose
        // length is a little wrong scales them, but does not move the point where they vanish.
        const Real safe_radius = select(visible, radius, Real(1));
        const Real offset = det(center, direction);
        const Real across = cotangent * abs(direction.y);
        const Real from_closer = direction.x - across;
        const Real from_farther = direction.x + across;
        const auto crosses = from_closer > margin;
        c.meets = (outside & crosses) | ((!outside) & (abs(offset) < safe_radius));
        const Vec2<Real> closest{touching.x, copysign(touching.y, offset)};
        c.azimuth = select(outside & (!crosses), closest, direction);
        c.t = c.azimuth.x * m + c.azimuth.y * n;

        // Find the middle of the strip and half its width.
        c.offset = min(max(offset, -safe_radius), safe_radius);
        c.along = dot(center, c.azimuth);
        // These are sums of terms that are not negative; products may be too small to be represented.
        const Real inside_along = select(outside, Real(0), c.along / safe_radius);
        const Real inside_gap = (-gap / safe_radius) * (sum / safe_radius);
        const Real outside_square = select(crosses, from_closer * from_farther, Real(0));
        const Real square = select(outside, outside_square, fma(inside_along, inside_along, inside_gap));
        c.half_chord = sqrt(max(square, Real(0))) * safe_radius;

        // Find where the strip starts and ends. The product of near and far is that of gap and sum: none of them comes
        // from a difference, nor does the larger one fall below the root.
        const Real larger = max(abs(c.along) + c.half_chord, sqrt(abs(gap)) * sqrt(sum));
        const auto apart = larger > Real(kTiny<scalar_t<Real>>);
        const Real other = abs(gap) * (sum / select(apart, larger, Real(1)));
        c.far = select(outside | (c.along > Real(0)), larger, other);
        c.near = select(outside, min(other, c.far), Real(0));
        return c;
    }

    /// The unit direction of the half-plane that contains a direction, in the basis m, n.
    NUSSELT_HD Vec2<Real> azimuth_of(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> in_plane = normalize(Vec3<Real>{dot(wi, m), dot(wi, n), Real(0)});
        const auto parallel = (in_plane.x == Real(0)) & (in_plane.y == Real(0));
        return {select(parallel, Real(1), in_plane.x), in_plane.y};
    }

    /// The first point of a ray from the origin that stays in a half-plane and meets the closed cylinder; the closest
    /// point of the surface in that half-plane if rounding lets it miss.
    /// \param tangent l / rho of the direction.
    /// \return (l, rho)
    NUSSELT_HD Vec2<Real> first_point(const CylinderSlice<Real>& c, const Real& tangent) const noexcept {
        const Real on_side = c.near * tangent;
        const auto before = on_side < l0;
        const auto beyond = on_side > l1;
        const Real l = select(before, l0, select(beyond, l1, on_side));
        const Real on_cap = l / select(tangent == Real(0), Real(1), tangent);
        const Real rho = select(before | beyond, min(max(on_cap, c.near), c.far), c.near);
        return {l, rho};
    }
};

/// \param cylinder with coordinates of order one.
/// \param up       to which m leads as far as it can where the axis does not tell; may be zero.
template <class Real>
NUSSELT_INLINE CylinderView<Real> make_cylinder_view(const Cylinder<Real>& cylinder,
                                                     const Vec3<Real>& up) noexcept {
    const LineSegment<Real>& axis = cylinder.axis;
    CylinderView<Real> v;
    v.s = axis.s;
    v.start = axis.p0;
    v.end = end_of(axis);
    v.length = axis.length;
    v.radius = cylinder.radius;

    // Find the closest point of the axis, and whether the origin lies outside the infinite cylinder.
    const Vec3<Real> moment = cross(axis.p0, v.s);
    const Vec3<Real> closest = cross(v.s, moment);
    const Real distance = length(moment);
    v.gap = distance - v.radius;
    v.sum = distance + v.radius;

    // Tell whether anything is visible: the origin must not be inside or next to the surface. From twice kTiny on, any
    // point of the surface has a coordinate that inverse_length() can divide by.
    v.l0 = dot(v.start, v.s);
    v.l1 = dot(v.end, v.s);
    v.outside = (v.gap >= Real(0)) & (distance > Real(0));
    const Real apart = max(max(v.l0, -v.l1), v.gap);
    v.visible = (v.length > Real(0)) & (v.radius > Real(0)) & (apart > Real(2 * kTiny<scalar_t<Real>>));

    // Complete the axis to a basis, towards the closest point if there is one.
    const Vec3<Real> upwards = normalize(cross(v.s, cross(up, v.s)));
    const auto horizontal = (upwards.x == Real(0)) & (upwards.y == Real(0)) & (upwards.z == Real(0));
    const Vec3<Real> free = select(horizontal, Frame<Real>::from_normal(v.s).t, upwards);
    v.m = select(v.outside, normalize(closest), free);
    v.n = cross(v.s, v.m);
    v.center = {select(v.outside, distance, dot(closest, v.m)),
                select(v.outside, Real(0), dot(closest, v.n))};

    // Find the half-planes that touch.
    const Real safe_distance = select(v.outside, distance, Real(1));
    v.touching = {sqrt(max(v.gap, Real(0)) / safe_distance) * sqrt(v.sum / safe_distance),
                  v.radius / safe_distance};
    const Real safe_radius = select(v.visible, v.radius, Real(1));
    v.cotangent = min(sqrt(max(v.gap, Real(0))) * sqrt(v.sum) / safe_radius,
                      Real(std::numeric_limits<scalar_t<Real>>::max()));
    return v;
}

template <class Real, class Single>
NUSSELT_INLINE CylinderView<Real> broadcast(const CylinderView<Single>& v) noexcept {
    return {broadcast<Real>(v.s),
            broadcast<Real>(v.m),
            broadcast<Real>(v.n),
            broadcast<Real>(v.center),
            Real(v.radius),
            Real(v.gap),
            Real(v.sum),
            broadcast<Real>(v.start),
            broadcast<Real>(v.end),
            Real(v.l0),
            Real(v.l1),
            Real(v.length),
            broadcast<Real>(v.touching),
            Real(v.cotangent),
            mask_t<Real>(v.outside),
            mask_t<Real>(v.visible)};
}

/// The intersection of a ray with a light. If the ray does not hit, only `hits` is valid.
template <class Real>
struct LightHit {
    mask_t<Real> hits;
    Real distance; ///< [m]
    Real cosine;   ///< between the ray, backwards, and the normal of the light
};

/// The first point where a ray from the origin meets a closed cylinder from outside, on its lateral surface or on a cap.
/// Rays that start inside hit nothing.
/// \param wi unit direction.
template <class Real>
NUSSELT_HD inline LightHit<Real> intersect(const Cylinder<Real>& cylinder, const Vec3<Real>& wi) noexcept {
    // Cut the cylinder by the half-plane of the ray.
    const auto unit = to_unit_extent(cylinder);
    const CylinderView<Real> view = make_cylinder_view(unit.light, {Real(0), Real(0), Real(0)});
    const CylinderSlice<Real> slice = view.slice(view.azimuth_of(wi), Real(0));
    const Real sine = dot(wi, view.s);
    const Real cosine = max(dot(wi, slice.t), Real(0));

    // Test whether the ray meets the rectangle. It passes the strip from l = near tan(alpha) to far tan(alpha).
    const Real enters = slice.near * sine;
    const Real leaves = slice.far * sine;
    const auto reaches = max(enters, leaves) >= view.l0 * cosine;
    const auto starts = min(enters, leaves) <= view.l1 * cosine;
    // Along the axis, the caps must lie ahead.
    const auto ahead = max(cosine, sine * (view.l0 + view.l1)) > Real(0);
    const auto wide = slice.far > Real(0);
    const Real tangent = sine / max(cosine, Real(kTiny<scalar_t<Real>>));
    const Vec2<Real> p = view.first_point(slice, tangent);
    const auto hits = view.visible & slice.meets & reaches & starts & ahead & wide;

    // Find the cosine: on a cap it is that with the axis.
    const auto beyond_start = p.x > view.l0;
    const auto on_side = beyond_start & (p.x < view.l1);
    const Real facing = cosine * slice.half_chord / select(hits, view.radius, Real(1));
    return {mask_t<Real>(hits), length(Vec3<Real>{p.x, p.y, Real(0)}) * unit.inverse_scale,
            select(on_side, facing, abs(sine))};
}

NUSSELT_NAMESPACE_END
