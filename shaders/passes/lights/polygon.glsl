#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_GLSL
/// Polygonal lights as a shading point and a camera see them, as in src/render_cpu/kernel/lights/polygon_light.h.

#ifndef EMISSION_CELLS
#error EMISSION_CELLS must be 1 for environments without a portal and for products with images of polygons, else 0
#endif

#include "passes/lights/light_role.glsl"
#include "passes/lights/polygon_profile.glsl"
#include "passes/lights/polygon_texture.glsl"
#include "passes/lights/stored_polygon.glsl"

layout(constant_id = kPolygonsConstant) const bool kHasPolygons = true; ///< of uniform radiance
const bool kHasAnyPolygons = kHasPolygons || kHasTexturedPolygons || kHasProfiledPolygons;

layout(set = 0, binding = kPolygonLightsBinding, std430) readonly buffer PolygonLights { PolygonLightRecord polygon_lights[]; };

struct LocalPolygon {
    ConvexPolygon shape; ///< in shading space
    LightRole role;
    int texture_number;  ///< -1 for none
    TexturePlane plane;  ///< of the texture, in shading space
    uint profile;        ///< its first word, kNoWords for none
    ProfileAxes axes;    ///< of the profile, in shading space
    int environment;     ///< whose portal it is, -1 for a light
    Frame shading;       ///< of portals
};

/// \param shape of the light, in shading space
/// \param index among the polygonal lights
LocalPolygon local_polygon(const Surface surface, const ConvexPolygon shape, uint index) {
    // A planar light does not light itself, but rounding may put a point of it in front of its plane.
    uint number = light_number(kPolygonKind, index);
    bool is_lit = surface.light != int(number);
    // Comparisons with NaN are false: negated they keep it, so that it is counted.
    if (polygon_lights[index].is_two_sided == 0u) is_lit = is_lit && !(dot(shape.normal, shape.vertex[0]) >= 0.0);
    is_lit = is_lit && !(highest_vertex(shape) <= 0.0);
    LocalPolygon light;
    light.shape = shape;
    light.role = LightRole(is_lit, to_vec(polygon_lights[index].radiance), number);
    light.environment = -1;
    light.texture_number = polygon_lights[index].texture_number;
    if (kHasTexturedPolygons && light.texture_number >= 0)
        light.plane = to_shading_space(texture_plane(light.texture_number), surface.position, surface.shading);
    light.profile = polygon_lights[index].first_profile_word;
    if (kHasProfiledPolygons && light.profile != kNoWords)
        light.axes = to_shading_space(profile_axes(light.profile), surface.shading);
    return light;
}

/// The radiance along a ray that meets the light.
vec3 polygon_emission(uint index, const Ray ray) {
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
