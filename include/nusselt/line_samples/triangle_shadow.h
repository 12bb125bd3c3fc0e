#pragma once
/// The parts of the lines of a family that one triangle hides from a point.
///
/// Billen and Dutre 2016, Line Sampling for Direct Illumination, Sec. 5.2. Deviation: instead of intersecting triangles
/// and projecting what they have in common, the point t of a line is hidden if it lies in the cone of the triangle and
/// beyond its plane: four inequalities that are linear in t. Each edge gives the same bound to both of its triangles, bit
/// by bit, so that nothing shines through closed meshes.

#include <nusselt/line_samples/line_family.h>

NUSSELT_NAMESPACE_BEGIN

/// Occluders within this share of the way from the light are missed: the light is in the scene itself.
template <class Scalar>
inline constexpr Scalar kShadowEnd = Scalar(1) - Scalar(1e-4);

/// The lines of a family as a point sees them, for their shadows.
/// \tparam Real one family and point per lane, or scalar.
template <class Real>
struct ShadowFrame {
    Vec3<Real> across, along, normal; ///< as LinePlane, the normal pointing away from the point
    Vec3<Real> origin; ///< of the plane relative to the point, its coordinates along these three vectors [m]
};

/// \param plane in any space.
/// \param point in that space [m].
template <class Real>
NUSSELT_HD inline ShadowFrame<Real> make_shadow_frame(const LinePlane<Real>& plane,
                                                      const Vec3<Real>& point) noexcept {
    const Vec3<Real> to_origin = plane.origin - point;
    const Real distance = dot(to_origin, plane.normal);
    const Real side = copysign(Real(1), distance);
    return {plane.across,
            plane.along,
            side * plane.normal,
            {dot(to_origin, plane.across), dot(to_origin, plane.along), abs(distance)}};
}

/// Bounds on the hidden coordinates as linear functions of the offset: between the largest lower and the least upper one.
/// \tparam Real a triangle per lane, or scalar.
template <class Real>
struct TriangleShadow {
    static constexpr int kBounds = 4;
    Real lower[kBounds], lower_slope[kBounds];
    Real upper[kBounds], upper_slope[kBounds];
};

/// The part of a line that is hidden.
/// \tparam Real a line per lane, while the shadow may be scalar.
template <class Real, class ShadowReal>
NUSSELT_HD inline Interval<Real> hidden_interval(const TriangleShadow<ShadowReal>& shadow,
                                                 const Real& offset) noexcept {
    Interval<Real> hidden{fma(Real(shadow.lower_slope[0]), offset, Real(shadow.lower[0])),
                          fma(Real(shadow.upper_slope[0]), offset, Real(shadow.upper[0]))};
    for (int i = 1; i < TriangleShadow<ShadowReal>::kBounds; ++i) {
        hidden.begin = max(hidden.begin, fma(Real(shadow.lower_slope[i]), offset, Real(shadow.lower[i])));
        hidden.end = min(hidden.end, fma(Real(shadow.upper_slope[i]), offset, Real(shadow.upper[i])));
    }
    return hidden;
}

/// \param a, b, c corners relative to the point, in the axes of the frame, ordered by their position in the scene (such as
///                lexicographically) and not by winding: each edge is then the same for both of its triangles.
/// \param largest bound on offsets and coordinates along lines of the light [m].
template <class Real>
NUSSELT_HD inline TriangleShadow<Real>
make_triangle_shadow(const ShadowFrame<Real>& frame, const Vec3<Real>& a, const Vec3<Real>& b,
                     const Vec3<Real>& c, const Real& largest) noexcept {
    using Scalar = scalar_t<Real>;
    const Vec3<Real> ab = cross(a, b - a);
    const Vec3<Real> bc = cross(b, c - b);
    const Vec3<Real> ac = cross(a, c - a);
    const Vec3<Real> n = cross(b - a, c - a);
    const Real k = dot(n, a);
    const Real side = copysign(Real(1), k);
    TriangleShadow<Real> shadow;
    // Bounds without an effect stay finite, so that no product with an offset is NaN.
    const Real far = Real(4) * largest;
    const auto set = [&](int i, const Vec3<Real>& m, const Real& orientation, const Real& constant) {
        // m.(origin + offset across + t along) + constant >= 0, after the orientation.
        const Real at_origin = dot(m, frame.origin) + constant;
        const Real extent = max(max(abs(m.x), abs(m.y)), abs(m.z));
        const Real slope = copysign(max(abs(m.y), Real(Scalar(1e-20)) * extent), m.y);
        const auto usable = extent > Real(0);
        const Real inverse = Real(-1) / select(usable, slope, Real(1));
        const Real at_zero = at_origin * inverse;
        const Real per_offset = m.x * inverse;
        const auto is_lower = orientation * slope > Real(0);
        shadow.lower[i] = select(is_lower, at_zero, -far);
        shadow.lower_slope[i] = select(is_lower, per_offset, Real(0));
        shadow.upper[i] = select(is_lower, far, at_zero);
        shadow.upper_slope[i] = select(is_lower, Real(0), per_offset);
    };
    set(0, ab, side, Real(0));
    set(1, bc, side, Real(0));
    set(2, ac, -side, Real(0));
    set(3, Real(kShadowEnd<Scalar>) * n, side, -k);
    // Seen edge-on: nothing is hidden.
    const auto is_thin = k == Real(0);
    shadow.lower[0] = select(is_thin, far, shadow.lower[0]);
    shadow.lower_slope[0] = select(is_thin, Real(0), shadow.lower_slope[0]);
    shadow.upper[0] = select(is_thin, -far, shadow.upper[0]);
    shadow.upper_slope[0] = select(is_thin, Real(0), shadow.upper_slope[0]);
    return shadow;
}

NUSSELT_NAMESPACE_END
