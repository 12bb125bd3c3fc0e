#version 450
#extension GL_GOOGLE_include_directive : require
/// Draws all triangles of a scene: three vertices for each, without vertex input.

#include "passes/scene.glsl"

layout(location = 0) flat out uint drawn_number;
/// The plane of the triangle relative to the origin of the camera: a normal of any length, and its product with all points.
layout(location = 1) flat out vec4 plane;
/// The smallest and largest distance of its vertices, in units of the directions of camera rays.
layout(location = 2) flat out vec2 distances;

/// Clip coordinates x, y and w. \param p relative to the origin of the camera.
vec3 clip_coordinates(vec3 p) {
    float m[12] = scene.clip_from_world;
    return vec3(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]);
}

/// \param p relative to the origin of the camera
float distance_along_rays(vec3 p) {
    float m[4] = scene.distance_from_world;
    return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
}

vec3 from_camera(const DrawnTriangle drawn, uint corner) {
    uint vertex = triangles[drawn.triangle].vertex[corner];
    return world_point(drawn.instance, vertex_position(vertex)) - to_vec(scene.origin);
}

void main() {
    drawn_number = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    DrawnTriangle drawn = drawn_triangle(drawn_number);
    plane = vec4(0.0);
    distances = vec2(0.0);
    // Flat outputs come from the first vertex.
    if (corner == 0u) {
        vec3 a = from_camera(drawn, 0u);
        vec3 b = from_camera(drawn, 1u);
        vec3 c = from_camera(drawn, 2u);
        vec3 normal = cross(b - a, c - a);
        plane = vec4(normal, dot(normal, a));
        vec3 t = vec3(distance_along_rays(a), distance_along_rays(b), distance_along_rays(c));
        distances = vec2(min(min(t.x, t.y), t.z), max(max(t.x, t.y), t.z));
    }
    vec3 clip = clip_coordinates(from_camera(drawn, corner));
    // The place on the film where camera rays pass moves to the centre of the pixel.
    vec2 shift = vec2(2.0 * frame.offset[0] / float(scene.width), 2.0 * frame.offset[1] / float(scene.height));
    // Depth comes from the fragment shader: interpolated, it is inaccurate on triangles that pass the camera.
    gl_Position = vec4(clip.xy - shift * clip.z, 0.0, clip.z);
}
