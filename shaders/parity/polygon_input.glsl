// The polygons of C++ among the inputs.
#include "parity/buffers.glsl"

// Their bound on the number of vertices, at most NUSSELT_MAX_VERTICES.
#ifndef LIGHT_VERTICES
#define LIGHT_VERTICES NUSSELT_MAX_VERTICES
#endif
const uint kPolygonSize = 6u * uint(LIGHT_VERTICES) + 3u;

// A ConvexPolygon<float, LIGHT_VERTICES> of C++: vertices, edges and normal.
ConvexPolygon input_polygon(uint begin) {
    uint bound = uint(LIGHT_VERTICES);
    vec3 vertices[NUSSELT_MAX_VERTICES];
    vec3 edges[NUSSELT_MAX_VERTICES];
    for (uint j = 0u; j < uint(NUSSELT_MAX_VERTICES); ++j) {
        vertices[j] = input_vec3(begin + 3u * min(j, bound - 1u));
        edges[j] = j + 1u < bound ? input_vec3(begin + 3u * (bound + j)) : vec3(0.0);
    }
    edges[NUSSELT_MAX_VERTICES - 1] = input_vec3(begin + 3u * (2u * bound - 1u));
    return make_polygon(vertices, edges, input_vec3(begin + 6u * bound));
}
