#ifndef PAGE_LIGHTS_GLSL
#define PAGE_LIGHTS_GLSL
/// Lights as a shading point sees them. Each kind has the same functions: local_kind(), is_lit(), kind_emission(),
/// and arrays kind_numbers, which number all lights of the scene.

#include "nusselt/geometry/convex_polygon.glsl"
#include "nusselt/geometry/cylinder.glsl"
#include "surface.glsl"

const int kMostLights = @most_lights@;     ///< of each kind
const int kLightVertices = @light_vertices@; ///< of a polygonal light; programs may have room for more

uniform int polygon_count;
uniform vec3 polygon_vertices[kMostLights * kLightVertices]; ///< [m]
uniform vec3 polygon_edges[kMostLights * kLightVertices];
uniform vec3 polygon_normals[kMostLights];
uniform vec3 polygon_radiances[kMostLights]; ///< [W/(sr m^2)]
uniform int polygon_numbers[kMostLights];

// Tubes are lines, which stand for thin tubes, or cylinders.
uniform int line_count;
uniform vec3 line_begins[kMostLights];     ///< [m]
uniform vec4 line_directions[kMostLights]; ///< unit direction, and length [m]
uniform vec4 line_radiances[kMostLights];  ///< radiance [W/(sr m^2)], and radius [m]
uniform int line_numbers[kMostLights];

uniform int cylinder_count;
uniform vec3 cylinder_begins[kMostLights];
uniform vec4 cylinder_directions[kMostLights];
uniform vec4 cylinder_radiances[kMostLights];
uniform int cylinder_numbers[kMostLights];

ConvexPolygon local_polygon(Surface surface, int index) {
    vec3 vertices[NUSSELT_MAX_VERTICES];
    vec3 edges[NUSSELT_MAX_VERTICES];
    for (int j = 0; j < NUSSELT_MAX_VERTICES; ++j) {
        // Further slots repeat the last vertex, and the last edge closes the polygon.
        bool is_last = j == NUSSELT_MAX_VERTICES - 1;
        bool is_further = j >= kLightVertices - 1 && !is_last;
        vertices[j] = polygon_vertices[index * kLightVertices + min(j, kLightVertices - 1)];
        edges[j] = is_further ? vec3(0.0) : polygon_edges[index * kLightVertices + (is_last ? kLightVertices - 1 : j)];
    }
    return to_shading_space(make_polygon(vertices, edges, polygon_normals[index]), surface.position, surface.shading);
}

LineSegment local_line(Surface surface, int index) {
    vec4 direction = line_directions[index];
    LineSegment world = LineSegment(line_begins[index], direction.xyz, direction.w);
    return to_shading_space(world, surface.position, surface.shading);
}

Cylinder local_cylinder(Surface surface, int index) {
    vec4 direction = cylinder_directions[index];
    LineSegment axis = LineSegment(cylinder_begins[index], direction.xyz, direction.w);
    return to_shading_space(Cylinder(axis, cylinder_radiances[index].w), surface.position, surface.shading);
}

/// Whether a light may reach the surface. Polygons emit to the side of their normal.
bool is_lit(Surface surface, ConvexPolygon light, int number) {
    float highest = light.vertex[0].z;
    for (int j = 1; j < kNusseltSlots; ++j) highest = max(highest, light.vertex[j].z);
    // A planar light does not light itself, but rounding may put a point of it in front of its plane.
    return surface.light != number && dot(light.normal, light.vertex[0]) < 0.0 && highest > 0.0;
}

bool is_lit(Surface surface, LineSegment light, int number) {
    return max(light.p0.z, light.p0.z + light.len * light.s.z) > 0.0;
}

bool is_lit(Surface surface, Cylinder light, int number) {
    float highest = max(light.axis.p0.z, light.axis.p0.z + light.axis.len * light.axis.s.z);
    return highest + light.radius * sqrt(max(1.0 - light.axis.s.z * light.axis.s.z, 0.0)) > 0.0;
}

vec3 polygon_emission(int index) { return polygon_radiances[index]; }
/// In the limit of thin tubes, emission and densities are those of the tube times its radius.
vec3 line_emission(int index) { return line_radiances[index].w * line_radiances[index].xyz; }
vec3 cylinder_emission(int index) { return cylinder_radiances[index].xyz; }

#endif
