#version 450
#extension GL_GOOGLE_include_directive : require
/// Writes the number of the triangle that a camera ray hits, plus one.

#include "passes/shadow_ray.glsl"
#include "passes/texture.glsl"

layout(location = 0) flat in uint drawn_number;
layout(location = 1) flat in vec4 plane;
layout(location = 2) flat in vec2 distances;
layout(location = 0) out uint number;

bool is_there(const Ray ray) {
    DrawnTriangle drawn = drawn_triangle(drawn_number);
    if (!drawn.is_surface) return true;
    MaterialRecord material = materials[triangles[drawn.triangle].material];
    vec2 at = barycentrics(drawn, triangle_edges(drawn.triangle), ray);
    float alpha = alpha_of(material, interpolated_uv(drawn.triangle, at));
    return meets_surface(ShadowRay(ray.origin, ray.direction, 0.0), drawn.triangle, uint(drawn.instance), alpha);
}

void main() {
    Ray ray = camera_ray(ivec2(gl_FragCoord.xy));
    float t = (plane.w - dot(plane.xyz, ray.origin - to_vec(scene.origin))) / dot(plane.xyz, ray.direction);
    // The division is inaccurate for triangles that are seen edge-on.
    t = clamp(t, distances.x, distances.y);
    if (!(t > 0.0)) discard;
    if (kHasPartial && !is_there(ray)) discard;
    gl_FragDepth = 1.0 / (1.0 + t * scene.inverse_depth_unit);
    number = drawn_number + 1u;
}
