#ifndef NUSSELT_PASSES_SCENE_GLSL
#define NUSSELT_PASSES_SCENE_GLSL
/// The buffers of a scene that all passes read, and the triangles that are drawn.

#include "interface/scene.h"
#include "passes/rounds/round_records.glsl"
#include "passes/scene_kinds.glsl"
#include "passes/to_vec.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Scene { SceneRecord scene; };
layout(set = 0, binding = 1, std430) readonly buffer Vertices { VertexRecord vertices[]; };
layout(set = 0, binding = 2, std430) readonly buffer Triangles { TriangleRecord triangles[]; };
layout(set = 0, binding = 3, std430) readonly buffer Instances { InstanceRecord instances[]; };
layout(set = 0, binding = 4, std430) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = 5, std430) readonly buffer Textures { TextureRecord textures[]; };
layout(set = 0, binding = 6, std430) readonly buffer TextureWords { uint texture_words[]; };
layout(push_constant, std430) uniform Frame_ { FrameRecord frame; };

/// A drawn triangle, or a round light.
struct DrawnTriangle {
    uint triangle; ///< index into triangles[]; one of those of the round light
    int instance;  ///< index into instances[], -1 for triangles of the world
    bool is_surface; ///< otherwise part of a light that is no surface
    int round;     ///< index into round_lights[], -1 for triangles
    int crossing;  ///< where the ray crosses the round light: 0 or 1
};

/// \param number among all triangles that are drawn
DrawnTriangle drawn_triangle(uint number) {
#if ROUND_LIGHTS
    if (kHasRounds && number >= scene.first_round_drawn) {
        uint crossing = number - scene.first_round_drawn;
        return DrawnTriangle(round_lights[crossing / 2u].triangle, -1, true, int(crossing / 2u), int(crossing % 2u));
    }
#endif
    if (number >= scene.first_light_drawn)
        return DrawnTriangle(scene.first_light_triangle + (number - scene.first_light_drawn), -1, false, -1, 0);
    if (!kHasInstances || number < scene.world_triangles) return DrawnTriangle(number, -1, true, -1, 0);
    // The last instance that begins at this number or before.
    uint first = 0u;
    uint end = scene.instances;
    while (end - first > 1u) {
        uint middle = first + (end - first) / 2u;
        if (instances[middle].first_drawn <= number)
            first = middle;
        else
            end = middle;
    }
    uint triangle = instances[first].first_triangle + (number - instances[first].first_drawn);
    return DrawnTriangle(triangle, int(first), true, -1, 0);
}

vec3 vertex_position(uint vertex) { return to_vec(vertices[vertex].position); }

vec3 linear_image(int instance, vec3 v) {
    float m[12] = instances[instance].world_from_object;
    return vec3(m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
                m[8] * v.x + m[9] * v.y + m[10] * v.z);
}

/// Transforms a point from the coordinates of an instance to those of the world. \param instance -1 for none
vec3 world_point(int instance, vec3 p) {
    if (instance < 0) return p;
    float m[12] = instances[instance].world_from_object;
    return linear_image(instance, p) + vec3(m[3], m[7], m[11]);
}

/// Transforms a vector likewise.
vec3 world_vector(int instance, vec3 v) { return instance < 0 ? v : linear_image(instance, v); }

struct Ray {
    vec3 origin;
    vec3 direction; ///< not of unit length
};

/// The same bits as on the CPU, because the decisions of surfaces with an alpha below 1 depend on them.
/// \param pixel of the image
Ray camera_ray(ivec2 pixel) {
    precise vec2 raster = vec2(0.5 + frame.offset[0], 0.5 + frame.offset[1]) +
                          vec2(float(scene.x_begin + pixel.x), float(scene.y_begin + pixel.y));
    precise vec3 origin =
        to_vec(scene.origin) + raster.x * to_vec(scene.origin_right) + raster.y * to_vec(scene.origin_down);
    precise vec3 direction =
        to_vec(scene.corner) + raster.x * to_vec(scene.right) + raster.y * to_vec(scene.down);
    return Ray(origin, direction);
}

/// The edges of a triangle, in the coordinates of its object.
struct TriangleEdges {
    vec3 v0, e1, e2;
};

TriangleEdges triangle_edges(uint triangle) {
    vec3 v0 = vertex_position(triangles[triangle].vertex[0]);
    return TriangleEdges(v0, vertex_position(triangles[triangle].vertex[1]) - v0,
                         vertex_position(triangles[triangle].vertex[2]) - v0);
}

/// Barycentric coordinates where a ray meets a triangle. Rasterisation rounds, so the ray may narrowly miss it.
vec2 barycentrics(const DrawnTriangle drawn, const TriangleEdges edges, const Ray ray) {
    vec3 e1 = world_vector(drawn.instance, edges.e1);
    vec3 e2 = world_vector(drawn.instance, edges.e2);
    vec3 from_v0 = ray.origin - world_point(drawn.instance, edges.v0);
    vec3 across = cross(ray.direction, e2);
    float inverse = 1.0 / dot(e1, across);
    float u = dot(from_v0, across) * inverse;
    float v = dot(ray.direction, cross(from_v0, e1)) * inverse;
    // A ray that misses a surface seen edge-on may meet its plane far away. NaN
    // becomes 0.
    u = u > 0.0 ? u : 0.0;
    v = v > 0.0 ? v : 0.0;
    float scale = 1.0 / max(u + v, 1.0);
    return scale * vec2(u, v);
}

vec2 interpolated_uv(uint triangle, vec2 at) {
    uint a = triangles[triangle].vertex[0];
    uint b = triangles[triangle].vertex[1];
    uint c = triangles[triangle].vertex[2];
    vec2 uv_a = vec2(vertices[a].uv[0], vertices[a].uv[1]);
    vec2 uv_b = vec2(vertices[b].uv[0], vertices[b].uv[1]);
    vec2 uv_c = vec2(vertices[c].uv[0], vertices[c].uv[1]);
    return uv_a + at.x * (uv_b - uv_a) + at.y * (uv_c - uv_a);
}

#endif
