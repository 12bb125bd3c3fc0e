#pragma once
/// Clipping of the vertices of a convex polygon to the horizon (Peters 2021, polygonal lights, supplement A.1), for
/// published methods, which know a light by its vertices alone.

#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN
namespace peters {

/// The point where the edge between two vertices meets the horizon.
template <class Real>
NUSSELT_INLINE Vec3<Real> horizon_crossing(const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
    const Real t = a.z / (a.z - b.z);
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), Real(0)};
}

/// For scalars: writes as many vertices as there are above the horizon, without those that repeat their successor.
/// \param v room for N + 1 vertices.
/// \returns the number of vertices.
template <int N, class Real>
NUSSELT_INLINE int clip_to_outline(const Vec3<Real>* vertex, Vec3<Real>* v) noexcept {
    int count = 0;
    for (int j = 0; j < N; ++j) {
        const Vec3<Real>& a = vertex[j];
        const Vec3<Real>& b = vertex[j + 1 < N ? j + 1 : 0];
        const bool is_repeated = a.x == b.x && a.y == b.y && a.z == b.z;
        if (a.z > Real(0) && !is_repeated && count < N + 1) v[count++] = a;
        if ((a.z > Real(0)) != (b.z > Real(0)) && count < N + 1) v[count++] = horizon_crossing(a, b);
    }
    return count;
}

/// For packs: writes N + 1 vertices above the horizon. Spare slots repeat vertices.
template <int N, class Real>
NUSSELT_INLINE void clip_to_slots(const Vec3<Real>* vertex, Vec3<Real>* v) noexcept {
    using Mask = mask_t<Real>;
    // Each lower vertex becomes the point where the boundary comes up again; the point where it goes down is inserted
    // before the first of them.
    Vec3<Real> down{Real(0), Real(0), Real(0)};
    Vec3<Real> up = down;
    Mask above[N], goes_down[N];
    for (int j = 0; j < N; ++j) above[j] = vertex[j].z > Real(0);
    for (int j = 0; j < N; ++j) {
        const int next = j + 1 < N ? j + 1 : 0;
        goes_down[j] = above[j] & !above[next];
        const Vec3<Real> point = horizon_crossing(vertex[j], vertex[next]);
        down = select(goes_down[j], point, down);
        up = select(above[next] & !above[j], point, up);
    }
    Mask inserted = Mask(false);
    for (int k = 0; k < N; ++k) {
        const Mask insert = goes_down[k > 0 ? k - 1 : N - 1];
        const int before = k > 0 ? k - 1 : 0;
        const Vec3<Real> kept = select(above[k], vertex[k], up);
        const Vec3<Real> shifted = select(above[before], vertex[before], up);
        v[k] = select(insert, down, select(inserted, shifted, kept));
        inserted = inserted | insert;
    }
    v[N] = select(above[N - 1], vertex[N - 1], up);
}

} // namespace peters
NUSSELT_NAMESPACE_END
