#ifndef NUSSELT_PASSES_LIGHTS_GLSL
#define NUSSELT_PASSES_LIGHTS_GLSL
/// Lights as a shading point sees them, as in src/render_cpu/kernel/reflected_light.h.

/// NUSSELT_MAX_VERTICES is LIGHT_VERTICES, or one more where lights are clipped twice.
#ifndef LIGHT_VERTICES
#error LIGHT_VERTICES must be 4 or 8: the vertices that each polygonal light has room for
#endif

#include "nusselt/geometry/convex_polygon.glsl"
#include "nusselt/geometry/line_segment.glsl"
#include "passes/surface.glsl"

layout(set = 0, binding = 7, std430) readonly buffer PolygonLights { PolygonLightRecord polygon_lights[]; };
/// Of each polygonal light LIGHT_VERTICES vertices, then as many edges.
layout(set = 0, binding = 8, std430) readonly buffer PolygonCorners { float polygon_corners[]; };
layout(set = 0, binding = 9, std430) readonly buffer LineLights { LineLightRecord line_lights[]; };

// The lights that are shaded at once: polygons come before lines and tubes.
uint polygons_end() { return min(scene.polygon_lights, frame.light_end); }
uint first_line() { return max(frame.first_light, scene.polygon_lights) - scene.polygon_lights; }
uint lines_end() { return max(frame.light_end, scene.polygon_lights) - scene.polygon_lights; }

/// What all kinds of lights have in common.
struct LightRole {
    bool is_lit;   ///< whether it may light the point
    vec3 emission; ///< radiance, of thin lines times radius
    uint number;   ///< among all lights of the scene
};

struct LocalPolygon {
    ConvexPolygon shape; ///< in shading space
    LightRole role;
};

struct LocalLine {
    LineSegment shape; ///< in shading space; of tubes the axis
    bool is_solid;     ///< a tube as the cylinder that it is
    float radius;      ///< of tubes
    LightRole role;
};

vec3 polygon_corner(uint number) {
    uint at = 3u * number;
    return vec3(polygon_corners[at], polygon_corners[at + 1u], polygon_corners[at + 2u]);
}

LocalPolygon local_polygon(Surface surface, uint index) {
    const int n = NUSSELT_MAX_VERTICES;
    uint begin = uint(2 * LIGHT_VERTICES) * index;
    vec3 corners[NUSSELT_MAX_VERTICES];
    vec3 edges[NUSSELT_MAX_VERTICES];
    for (int j = 0; j < n; ++j) {
        corners[j] = polygon_corner(begin + uint(min(j, LIGHT_VERTICES - 1)));
        edges[j] = vec3(0.0);
    }
    for (int j = 0; j < LIGHT_VERTICES - 1; ++j) edges[j] = polygon_corner(begin + uint(LIGHT_VERTICES + j));
    edges[n - 1] = polygon_corner(begin + uint(2 * LIGHT_VERTICES - 1));
    ConvexPolygon world = make_polygon(corners, edges, to_vec(polygon_lights[index].normal));
    ConvexPolygon local = to_shading_space(world, surface.position, surface.shading);
    // A planar light does not light itself, but rounding may put a point of it in front of its plane.
    bool is_lit = surface.light != int(index);
    // Comparisons with NaN are false: negated they keep it, so that it is counted.
    if (polygon_lights[index].is_two_sided == 0u) is_lit = is_lit && !(dot(local.normal, local.vertex[0]) >= 0.0);
    float highest = local.vertex[0].z;
    for (int j = 1; j < NUSSELT_MAX_VERTICES; ++j) highest = nusselt_max(highest, local.vertex[j].z);
    is_lit = is_lit && !(highest <= 0.0);
    return LocalPolygon(local, LightRole(is_lit, to_vec(polygon_lights[index].radiance), index));
}

/// \param index among the lines and tubes
LocalLine local_line(Surface surface, uint index) {
    LineLightRecord record = line_lights[index];
    LineSegment world = LineSegment(to_vec(record.begin), to_vec(record.direction), record.len);
    LineSegment local = to_shading_space(world, surface.position, surface.shading);
    bool is_solid = record.is_solid != 0u;
    float highest = nusselt_max(local.p0.z, local.p0.z + local.len * local.s.z);
    if (is_solid) highest += record.radius * sqrt(nusselt_max(1.0 - local.s.z * local.s.z, 0.0));
    vec3 emission = to_vec(record.radiance);
    if (!is_solid) emission = record.radius * emission;
    return LocalLine(local, is_solid, record.radius, LightRole(!(highest <= 0.0), emission, scene.polygon_lights + index));
}

/// Radiance that a camera sees of lights themselves.
vec3 emission_of(DrawnTriangle drawn, Ray ray) {
    if (drawn.tube >= 0) return to_vec(line_lights[drawn.tube].radiance);
    int index = triangles[drawn.triangle].light;
    if (index < 0) return vec3(0.0);
    bool is_seen = polygon_lights[index].is_two_sided != 0u ||
                   dot(to_vec(polygon_lights[index].normal), ray.direction) < 0.0;
    return is_seen ? to_vec(polygon_lights[index].radiance) : vec3(0.0);
}

#endif
