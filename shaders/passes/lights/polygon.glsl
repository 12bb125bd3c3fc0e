#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_GLSL
/// Polygonal lights as a shading point and a camera see them, as in src/render_cpu/kernel/lights/polygon_light.h.

// NUSSELT_MAX_VERTICES is LIGHT_VERTICES, or one more where lights are clipped twice.
#ifndef LIGHT_VERTICES
#error LIGHT_VERTICES must be 4 or 8: the vertices that each polygonal light has room for
#endif

#ifndef EMISSION_CELLS
#error EMISSION_CELLS must be 1 for environments and where images of polygons decide where samples are, else 0: it compiles longer
#endif

#include "nusselt/geometry/convex_polygon.glsl"
#include "passes/lights/light_role.glsl"
#include "passes/lights/polygon_profile.glsl"
#include "passes/lights/polygon_texture.glsl"

layout(constant_id = kPolygonsConstant) const bool kHasPolygons = true; ///< of uniform radiance
const bool kHasAnyPolygons = kHasPolygons || kHasTexturedPolygons || kHasProfiledPolygons;

layout(set = 0, binding = kPolygonLightsBinding, std430) readonly buffer PolygonLights { PolygonLightRecord polygon_lights[]; };
/// For each polygonal light LIGHT_VERTICES vertices, then as many edges.
layout(set = 0, binding = kPolygonCornersBinding, std430) readonly buffer PolygonCorners { float polygon_corners[]; };

struct LocalPolygon {
    ConvexPolygon shape; ///< in shading space
    LightRole role;
    int texture_number;  ///< -1 for none
    TexturePlane plane;  ///< of the texture, in shading space
    uint profile;        ///< its first word, kNoWords for none
    ProfileAxes axes;    ///< of the profile, in shading space
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
    uint number = light_number(kPolygonKind, index);
    bool is_lit = surface.light != int(number);
    // Comparisons with NaN are false: negated they keep it, so that it is counted.
    if (polygon_lights[index].is_two_sided == 0u) is_lit = is_lit && !(dot(local.normal, local.vertex[0]) >= 0.0);
    float highest = local.vertex[0].z;
    for (int j = 1; j < NUSSELT_MAX_VERTICES; ++j) highest = nusselt_max(highest, local.vertex[j].z);
    is_lit = is_lit && !(highest <= 0.0);
    LocalPolygon light;
    light.shape = local;
    light.role = LightRole(is_lit, to_vec(polygon_lights[index].radiance), number);
    light.texture_number = polygon_lights[index].texture_number;
    if (kHasTexturedPolygons && light.texture_number >= 0)
        light.plane = to_shading_space(texture_plane(light.texture_number), surface.position, surface.shading);
    light.profile = polygon_lights[index].first_profile_word;
    if (kHasProfiledPolygons && light.profile != kNoWords)
        light.axes = to_shading_space(profile_axes(light.profile), surface.shading);
    return light;
}

/// The radiance along a ray that meets the light.
vec3 polygon_emission(uint index, Ray ray) {
    bool is_seen =
        polygon_lights[index].is_two_sided != 0u || dot(to_vec(polygon_lights[index].normal), ray.direction) < 0.0;
    if (!is_seen) return vec3(0.0);
    int texture_number = polygon_lights[index].texture_number;
    if (kHasTexturedPolygons && texture_number >= 0) return texture_radiance_along(texture_number, ray);
    vec3 radiance = to_vec(polygon_lights[index].radiance);
    uint profile = polygon_lights[index].first_profile_word;
    if (kHasProfiledPolygons && profile != kNoWords)
        radiance *= relative_radiance(profile, profile_axes(profile), -nusselt_normalize(ray.direction));
    return radiance;
}

#endif
