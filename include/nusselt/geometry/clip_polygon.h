#pragma once
/// Clipping of convex polygons to the upper hemisphere.

#include <nusselt/geometry/convex_polygon.h>

NUSSELT_NAMESPACE_BEGIN

/// The part of a polygon in shading space with z > 0 (Peters 2021, polygonal lights, supplement A.1,
/// re-derived). The boundary meets the plane in at most two points, so that there is at most one vertex more.
///
/// New vertices get z = 0 exactly and the edge between them the exact normal (0, 0, n_z). New edges are parts
/// of the old ones, or for the edge along the horizon the negative sum of all others, so that they stay as
/// accurate relative to the size of the polygon as the edges of the input. Nothing above the horizon: all
/// vertices and edges are zero.
template <class Real, int N>
NUSSELT_HD inline ConvexPolygon<Real, N + 1> clip_to_horizon(const ConvexPolygon<Real, N>& polygon) noexcept {
    using Mask = mask_t<Real>;
    const Vec3<Real> zero{Real(0), Real(0), Real(0)};
    // Classify the vertices. One on the horizon counts as below: the crossing on its edge to an upper neighbour
    // reproduces it.
    Mask above[N];
    Mask all_above = Mask(true);
    for (int j = 0; j < N; ++j) {
        above[j] = polygon.vertex[j].z > Real(0);
        all_above = all_above & above[j];
    }

    // Nothing to clip: repeat the last vertex.
    ConvexPolygon<Real, N + 1> clipped;
    clipped.normal = polygon.normal;
    if (all(all_above)) {
        for (int j = 0; j < N; ++j) {
            clipped.vertex[j] = polygon.vertex[j];
            clipped.edge[j] = j + 1 < N ? polygon.edge[j] : zero;
        }
        clipped.vertex[N] = polygon.vertex[N - 1];
        clipped.edge[N] = polygon.edge[N - 1];
        return clipped;
    }

    // Find the two crossings with the horizon. Each lower vertex is replaced by the point where the boundary comes up
    // again; the point where it goes down is inserted before the first of them.
    Vec3<Real> down = zero;
    Vec3<Real> up = zero;
    Vec3<Real> sum_of_edges = zero;
    Real extents_of_edges = Real(0);
    Vec3<Real> edge[N];
    Mask goes_down[N];
    for (int j = 0; j < N; ++j) {
        const int next = j + 1 < N ? j + 1 : 0;
        const Vec3<Real>& a = polygon.vertex[j];
        const Vec3<Real>& b = polygon.vertex[next];
        const Vec3<Real>& e = polygon.edge[j];
        goes_down[j] = above[j] & (!above[next]);
        const Mask goes_up = (!above[j]) & above[next];
        const Real drop = abs(a.z - b.z);
        const Real share =
            max(a.z, b.z) / select(drop > Real(0), drop, Real(1)); // of the edge above the horizon
        const Vec3<Real> part{share * e.x, share * e.y, select(goes_down[j], -a.z, b.z)};
        // A vertex on the horizon stays exactly where it is.
        const Vec3<Real> end{select(b.z == Real(0), b.x, a.x + part.x),
                             select(b.z == Real(0), b.y, a.y + part.y), Real(0)};
        const Vec3<Real> begin{select(a.z == Real(0), a.x, b.x - part.x),
                               select(a.z == Real(0), a.y, b.y - part.y), Real(0)};
        down = select(goes_down[j], end, down);
        up = select(goes_up, begin, up);
        edge[j] = select(above[j] & above[next], e, select(goes_down[j] | goes_up, part, zero));
        sum_of_edges = sum_of_edges + edge[j];
        extents_of_edges = extents_of_edges + max(max(abs(edge[j].x), abs(edge[j].y)), abs(edge[j].z));
    }

    // Close the polygon along the horizon. The sum of edges is rounding, of any direction, where the polygon only
    // touches the horizon.
    const Real rounding = Real(4 * std::numeric_limits<scalar_t<Real>>::epsilon()) * extents_of_edges;
    const Mask touches = max(abs(sum_of_edges.x), abs(sum_of_edges.y)) <= rounding;
    const Vec3<Real> along_horizon =
        select(touches, zero, Vec3<Real>{-sum_of_edges.x, -sum_of_edges.y, Real(0)});
    down = select(touches, up, down);

    // Write the new vertices and edges, shifted by one slot from the inserted vertex on.
    Mask inserted = Mask(false);
    for (int k = 0; k < N; ++k) {
        const Mask insert = goes_down[k > 0 ? k - 1 : N - 1];
        const int before = k > 0 ? k - 1 : 0;
        const Vec3<Real> kept = select(above[k], polygon.vertex[k], up);
        const Vec3<Real> shifted = select(above[before], polygon.vertex[before], up);
        clipped.vertex[k] = select(insert, down, select(inserted, shifted, kept));
        clipped.edge[k] = select(insert, along_horizon, select(inserted, edge[before], edge[k]));
        inserted = inserted | insert;
    }
    clipped.vertex[N] = select(above[N - 1], polygon.vertex[N - 1], up);
    clipped.edge[N] = edge[N - 1];
    clipped.edge[N - 1] = select(inserted, clipped.edge[N - 1], zero);
    return clipped;
}

NUSSELT_NAMESPACE_END
