#ifndef NUSSELT_PASSES_LIGHTS_STORED_POLYGON_GLSL
#define NUSSELT_PASSES_LIGHTS_STORED_POLYGON_GLSL
/// The polygons of records, as in src/render_cpu/kernel/lights/stored_polygon.h.

// NUSSELT_MAX_VERTICES is LIGHT_VERTICES, or one more where lights are clipped twice.
#ifndef LIGHT_VERTICES
#error LIGHT_VERTICES must be 4 or 8: the vertices that each polygonal light or portal has room for
#endif

#include "nusselt/geometry/convex_polygon.glsl"
#include "passes/scene.glsl"

/// For each polygon LIGHT_VERTICES vertices, then as many edges.
layout(set = 0, binding = kPolygonCornersBinding, std430) readonly buffer PolygonCorners { float polygon_corners[]; };

/// \param number of a vertex, or that of an edge and LIGHT_VERTICES
vec3 polygon_corner(uint first_word, int number) {
    uint at = first_word + 3u * uint(number);
    return vec3(polygon_corners[at], polygon_corners[at + 1u], polygon_corners[at + 2u]);
}

/// In world space.
ConvexPolygon stored_polygon(uint first_word, vec3 normal) {
    const int n = NUSSELT_MAX_VERTICES;
    vec3 corners[NUSSELT_MAX_VERTICES];
    vec3 edges[NUSSELT_MAX_VERTICES];
    for (int j = 0; j < n; ++j) {
        corners[j] = polygon_corner(first_word, min(j, LIGHT_VERTICES - 1));
        edges[j] = vec3(0.0);
    }
    for (int j = 0; j < LIGHT_VERTICES - 1; ++j) edges[j] = polygon_corner(first_word, LIGHT_VERTICES + j);
    edges[n - 1] = polygon_corner(first_word, 2 * LIGHT_VERTICES - 1);
    return make_polygon(corners, edges, normal);
}

/// The largest z of all vertices.
float highest_vertex(ConvexPolygon polygon) {
    float highest = polygon.vertex[0].z;
    for (int j = 1; j < NUSSELT_MAX_VERTICES; ++j) highest = nusselt_max(highest, polygon.vertex[j].z);
    return highest;
}

#endif
