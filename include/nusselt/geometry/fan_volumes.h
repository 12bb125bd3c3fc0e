#pragma once
/// Triple products of the triangles of a polygon, which decide how large it appears.

#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

/// Six times the volumes between the origin and the triangles of the fan around vertex 0 of a polygon, with the sign of
/// plane_distance().
template <class Real, int N>
struct FanVolumes {
    Real volume[N - 2];
    mask_t<Real> conclusive; ///< whether refine() would change only the last digits

    /// \param polygon relative to the shading point [m].
    NUSSELT_INLINE explicit FanVolumes(const ConvexPolygon<Real, N>& polygon) noexcept {
        const Vec3<Real>& v = polygon.vertex[0];
        Vec3<Real> offset = polygon.edge[0];
        Vec3<Real> normal = cross(offset, polygon.edge[1]);
        volume[0] = multiply_add(v.z, normal.z, multiply_add(v.y, normal.y, v.x * normal.x));
        NUSSELT_UNROLL
        for (int j = 1; j < N - 2; ++j) {
            offset = offset + polygon.edge[j];
            const Vec3<Real> n = cross(offset, polygon.edge[j + 1]);
            volume[j] = multiply_add(v.z, n.z, multiply_add(v.y, n.y, v.x * n.x));
            normal = normal + n;
        }
        const Real whole = total();
        // Squares that leave the range of numbers are not conclusive.
        constexpr scalar_t<Real> kSine = detail::kConclusive<scalar_t<Real>>;
        conclusive = whole * whole > Real(kSine * kSine) * dot(v, v) * dot(normal, normal);
    }

    /// For a polygon whose plane has a known distance.
    NUSSELT_HD FanVolumes(const ConvexPolygon<Real, N>& polygon, const Real& distance) noexcept
        : conclusive(true) {
        Vec3<Real> offset = polygon.edge[0];
        for (int j = 0; j < N - 2; ++j) {
            volume[j] = distance * abs(dot(polygon.normal, cross(offset, polygon.edge[j + 1])));
            offset = offset + polygon.edge[j + 1];
        }
    }

    /// Their sum.
    NUSSELT_INLINE Real total() const noexcept {
        Real sum = volume[0];
        for (int j = 1; j < N - 2; ++j) sum = sum + volume[j];
        return sum;
    }

    /// Computes volumes that are not conclusive once more, with products of twice the precision. They are 0 if the plane
    /// of the polygon cannot be told from one through the origin.
    NUSSELT_HD void refine(const ConvexPolygon<Real, N>& polygon) noexcept {
        const Real distance = detail::rounded_plane_distance(polygon, detail::nearest_vertex(polygon));
        const Real side = copysign(Real(1), distance);
        detail::for_each_precise_triangle(polygon, polygon.vertex[0], [&](int j, const Real& exact) {
            const Real precise = select(distance == Real(0), Real(0), max(side * exact, Real(0)));
            volume[j] = select(conclusive, volume[j], side * precise);
        });
    }
};

NUSSELT_NAMESPACE_END
