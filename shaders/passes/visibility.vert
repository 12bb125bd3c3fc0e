#version 450
#extension GL_GOOGLE_include_directive : require
/// Draws all triangles of a scene, and a box around each round light: three vertices for each triangle, without vertex
/// input.

#include "passes/scene.glsl"
#include "passes/rounds/round_surface.glsl"

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

/// Draws a corner. \param p relative to the origin of the camera
void place(vec3 p) {
    vec3 clip = clip_coordinates(p);
    // The place on the film where camera rays pass moves to the centre of the pixel.
    vec2 shift = vec2(2.0 * frame.offset[0] / float(scene.width), 2.0 * frame.offset[1] / float(scene.height));
    // Depth comes from the fragment shader: interpolated, it is inaccurate on triangles that pass the camera.
    gl_Position = vec4(clip.xy - shift * clip.z, 0.0, clip.z);
}

/// Draws nothing, where all corners of a triangle have this place.
void hide() { gl_Position = vec4(2.0, 0.0, 0.0, 1.0); }

/// A corner of the cube from -1 to 1. \param triangle 0 to 11: two on each side
vec3 cube_corner(uint triangle, uint corner) {
    uint axis = triangle / 4u;
    uint around = corner == 0u ? 0u : corner + triangle % 2u; // both triangles have the corners 0 and 2 of the side
    vec3 p;
    p[axis] = (triangle & 2u) != 0u ? 1.0 : -1.0;
    p[(axis + 1u) % 3u] = around == 1u || around == 2u ? 1.0 : -1.0;
    p[(axis + 2u) % 3u] = around >= 2u ? 1.0 : -1.0;
    return p;
}

/// Draws a corner of a box around a round light, some pixels of which the light fills: the fragment shader finds out
/// which.
/// \param triangle among those of all boxes
void place_box(uint triangle, uint corner) {
    uint light = triangle / kRoundBoxTriangles;
    drawn_number = scene.first_round_drawn + 2u * light;
    if (round_lights[light].triangle == kNoTriangle) {
        hide();
        return;
    }
    // A little larger than the light, which touches the sides: rasterisation rounds.
    const float size = 1.05;
    vec3 p = size * cube_corner(triangle % kRoundBoxTriangles, corner);
    place(to_vec(round_lights[light].center) - to_vec(scene.origin) + from_unit_sphere(light, p));
}

bool is_of_round_light(uint triangle) {
    LightRange rounds = scene.lights[kRoundKind];
    return uint(triangles[triangle].light) - rounds.first < rounds.count;
}

void main() {
    drawn_number = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) % 3u;
    plane = vec4(0.0);
    distances = vec2(0.0);
    if (kHasRounds && drawn_number >= scene.first_round_drawn) {
        place_box(drawn_number - scene.first_round_drawn, corner);
        return;
    }
    DrawnTriangle drawn = drawn_triangle(drawn_number);
    if (kHasRounds && is_of_round_light(drawn.triangle)) {
        hide();
        return;
    }
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
    place(from_camera(drawn, corner));
}
