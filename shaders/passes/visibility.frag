#version 450
#extension GL_GOOGLE_include_directive : require
/// Writes the number of the triangle or the crossing of a round light that a camera ray hits, plus one.

#include "passes/alpha.glsl"
#include "passes/rounds/round_shadows.glsl"

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

void write_depth(float t) { gl_FragDepth = 1.0 / (1.0 + t * scene.inverse_depth_unit); }

/// \returns whether the ray meets the light
bool draw_round(uint light, const Ray ray) {
    UnitRay unit = unit_ray(light, ray.origin, ray.direction);
    RoundCrossings crossings = round_crossings(light, unit, 1.0);
    for (int i = 0; i < crossings.count; ++i) {
        float t = crossing_at(crossings, i);
        if (!(t > 0.0)) continue;
        vec3 point = crossing_point(light, unit, crossings, i);
        if (kHasPartial && round_lights[light].is_partial != 0u &&
            !meets_crossing(ShadowRay(ray.origin, ray.direction, 0.0), light, point, i))
            continue;
        write_depth(t);
        number = drawn_number + uint(i) + 1u;
        return true;
    }
    return false;
}

void main() {
    Ray ray = camera_ray(ivec2(gl_FragCoord.xy));
    if (kHasRounds && drawn_number >= scene.first_round_drawn) {
        if (!draw_round((drawn_number - scene.first_round_drawn) / 2u, ray)) discard;
        return;
    }
    float t = (plane.w - dot(plane.xyz, ray.origin - to_vec(scene.origin))) / dot(plane.xyz, ray.direction);
    // The division is inaccurate for triangles that are seen edge-on.
    t = clamp(t, distances.x, distances.y);
    if (!(t > 0.0)) discard;
    if (kHasPartial && !is_there(ray)) discard;
    write_depth(t);
    number = drawn_number + 1u;
}
