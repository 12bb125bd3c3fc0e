// Columns of a polygon of LIGHT_VERTICES vertices: vertices, edges (the last one closes the polygon) and normal.
#include "bench/workload.glsl"

const uint kPolygonColumns = 6u * uint(LIGHT_VERTICES) + 3u;

ConvexPolygon column_polygon(uint index, inout vec4 sum) {
    const uint bound = LIGHT_VERTICES;
    vec3 vertices[NUSSELT_MAX_VERTICES];
    vec3 edges[NUSSELT_MAX_VERTICES];
    vec3 all = vec3(0.0);
    NUSSELT_UNROLL for (uint j = 0u; j < NUSSELT_MAX_VERTICES; ++j) {
        vertices[j] = column_vec3(3u * min(j, bound - 1u), index);
        edges[j] = j + 1u < bound ? column_vec3(3u * (bound + j), index) : vec3(0.0);
        all += vertices[j] + edges[j];
    }
    edges[NUSSELT_MAX_VERTICES - 1] = column_vec3(3u * (2u * bound - 1u), index);
    const ConvexPolygon light = make_polygon(vertices, edges, column_vec3(6u * bound, index));
    sum.xyz += all + edges[NUSSELT_MAX_VERTICES - 1] + light.normal;
    return light;
}
