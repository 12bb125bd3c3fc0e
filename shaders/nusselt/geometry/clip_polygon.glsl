#ifndef NUSSELT_GEOMETRY_CLIP_POLYGON_GLSL
#define NUSSELT_GEOMETRY_CLIP_POLYGON_GLSL
// Follows include/nusselt/geometry/clip_polygon.h @ 8ed4e7acbbe9
/// Clipping of convex polygons to the upper hemisphere. Twin of include/nusselt/geometry/clip_polygon.h.

#include "../geometry/convex_polygon.glsl"

/// Whether all vertices have z > 0.
bool is_above_horizon(ConvexPolygon polygon) {
    bool all_above = true;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) all_above = all_above && polygon.vertex[j].z > 0.0;
    return all_above;
}

/// The part of a light in shading space with z > 0 (Peters 2021, polygonal lights, supplement A.1, re-derived).
///
/// New vertices get z = 0 exactly. New edges are parts of the old ones, or for the edge along the horizon the negative
/// sum of all others, so that they stay as accurate relative to the size of the polygon as those of the light. Nothing
/// above the horizon: all vertices and edges are zero.
/// \param polygon of at most NUSSELT_MAX_VERTICES vertices, i.e. not clipped before.
ConvexPolygon clip_to_horizon(ConvexPolygon polygon) {
    if (is_above_horizon(polygon)) return polygon;

    // Each lower vertex is replaced by the point where the boundary comes up again; the point where it goes down is
    // inserted before the first of them. A vertex on the horizon counts as below: the crossing on its edge to an upper
    // neighbour reproduces it.
    const int n = NUSSELT_MAX_VERTICES;
    vec3 down = vec3(0.0);
    vec3 up = vec3(0.0);
    vec3 sum_of_edges = vec3(0.0);
    float extents_of_edges = 0.0;
    vec3 edge[NUSSELT_MAX_VERTICES];
    bool goes_down[NUSSELT_MAX_VERTICES];
    NUSSELT_UNROLL for (int j = 0; j < n; ++j) {
        vec3 a = polygon.vertex[j];
        vec3 b = polygon.vertex[j + 1 < n ? j + 1 : 0];
        vec3 e = polygon.edge[j + 1 < n ? j : n];
        bool a_above = a.z > 0.0;
        bool b_above = b.z > 0.0;
        goes_down[j] = a_above && !b_above;
        bool goes_up = !a_above && b_above;
        float drop = abs(a.z - b.z);
        float share = nusselt_max(a.z, b.z) / (drop > 0.0 ? drop : 1.0); // of the edge above the horizon
        vec3 part = vec3(share * e.x, share * e.y, goes_down[j] ? -a.z : b.z);
        // A vertex on the horizon stays exactly where it is.
        if (goes_down[j]) down = vec3(b.z == 0.0 ? b.xy : a.xy + part.xy, 0.0);
        if (goes_up) up = vec3(a.z == 0.0 ? a.xy : b.xy - part.xy, 0.0);
        edge[j] = a_above && b_above ? e : (goes_down[j] || goes_up ? part : vec3(0.0));
        sum_of_edges = sum_of_edges + edge[j];
        vec3 extents = abs(edge[j]);
        extents_of_edges += nusselt_max(nusselt_max(extents.x, extents.y), extents.z);
    }
    // The sum is rounding, of any direction, where the polygon only touches the horizon.
    float rounding = 4.0 * kNusseltEpsilon * extents_of_edges;
    bool touches = nusselt_max(abs(sum_of_edges.x), abs(sum_of_edges.y)) <= rounding;
    vec3 along_horizon = touches ? vec3(0.0) : vec3(-sum_of_edges.xy, 0.0);
    if (touches) down = up;

    ConvexPolygon clipped;
    clipped.normal = polygon.normal;
    bool inserted = false;
    NUSSELT_UNROLL for (int k = 0; k < n; ++k) {
        bool insert = goes_down[k > 0 ? k - 1 : n - 1];
        int before = k > 0 ? k - 1 : 0;
        vec3 kept = polygon.vertex[k].z > 0.0 ? polygon.vertex[k] : up;
        vec3 shifted = polygon.vertex[before].z > 0.0 ? polygon.vertex[before] : up;
        clipped.vertex[k] = insert ? down : (inserted ? shifted : kept);
        clipped.edge[k] = insert ? along_horizon : (inserted ? edge[before] : edge[k]);
        inserted = inserted || insert;
    }
    clipped.vertex[n] = polygon.vertex[n - 1].z > 0.0 ? polygon.vertex[n - 1] : up;
    clipped.edge[n] = edge[n - 1];
    clipped.edge[n - 1] = inserted ? clipped.edge[n - 1] : vec3(0.0);
    return clipped;
}

#endif
