#ifndef NUSSELT_RELATED_CLIP_VERTICES_GLSL
#define NUSSELT_RELATED_CLIP_VERTICES_GLSL
// Follows include/nusselt/related/clip_vertices.h @ ab458de6b143
/// Clipping of the vertices of a convex polygon to the horizon (Peters 2021, polygonal lights, supplement A.1), for
/// published methods, which know a light by its vertices alone. Twin of include/nusselt/related/clip_vertices.h.

#include "../geometry/convex_polygon.glsl"

/// The point where an edge meets the horizon.
vec3 peters_crossing(vec3 a, vec3 b) {
    float t = a.z / (a.z - b.z);
    return vec3(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0.0);
}

/// The vertices above the horizon, the y axis mirrored where `mirror` is -1; spare slots repeat vertices.
void peters_clip(ConvexPolygon light, float mirror, out vec3 v[kNusseltSlots]) {
    // The last slot of a light is spare.
    const int kVertices = kNusseltSlots - 1;
    bool above[kNusseltSlots];
    bool all_above = true;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        v[j] = vec3(light.vertex[j].x, mirror * light.vertex[j].y, light.vertex[j].z);
        above[j] = v[j].z > 0.0;
        all_above = all_above && above[j];
    }
    if (all_above) return;
    // Each lower vertex becomes the point where the boundary comes up again; the point where it goes down is inserted
    // before the first of them.
    vec3 vertex[kNusseltSlots] = v;
    vec3 down = vec3(0.0);
    vec3 up = vec3(0.0);
    NUSSELT_UNROLL for (int j = 0; j < kVertices; ++j) {
        int next = j + 1 < kVertices ? j + 1 : 0;
        if (above[j] != above[next]) {
            vec3 point = peters_crossing(vertex[j], vertex[next]);
            if (above[j])
                down = point;
            else
                up = point;
        }
    }
    bool inserted = false;
    NUSSELT_UNROLL for (int k = 0; k < kVertices; ++k) {
        int before = k > 0 ? k - 1 : 0;
        bool insert = above[k > 0 ? k - 1 : kVertices - 1] && !above[k];
        vec3 kept = above[k] ? vertex[k] : up;
        vec3 shifted = above[before] ? vertex[before] : up;
        v[k] = insert ? down : (inserted ? shifted : kept);
        inserted = inserted || insert;
    }
    v[kVertices] = above[kVertices - 1] ? vertex[kVertices - 1] : up;
}

#endif
