#ifndef NUSSELT_PASSES_LIGHTS_PORTAL_GLSL
#define NUSSELT_PASSES_LIGHTS_PORTAL_GLSL
/// Portals of environments as a shading point sees them, as in src/render_cpu/kernel/lights/portal_light.h: polygons
/// that light passes both ways. They follow polygonal lights in the same loop: drivers would compile all techniques for
/// polygons twice.

#include "passes/lights/environment.glsl"
#include "passes/lights/polygon.glsl"

struct PolygonOrPortal {
    bool is_environment; ///< which has a portal or not
    uint index;          ///< among the polygonal lights, or among the environments
};

/// How many polygonal lights this part of the frame samples.
uint polygon_count() { return kHasAnyPolygons ? end_index(kPolygonKind) - first_index(kPolygonKind) : 0u; }

/// The same with environments, of which some may have no portal.
uint polygon_or_portal_count() {
    return polygon_count() + (kHasPortals ? end_index(kEnvironmentKind) - first_index(kEnvironmentKind) : 0u);
}

/// \param i below polygon_or_portal_count()
PolygonOrPortal polygon_or_portal(uint i) {
    uint polygons = polygon_count();
    if (kHasPortals && i >= polygons) return PolygonOrPortal(true, first_index(kEnvironmentKind) + i - polygons);
    return PolygonOrPortal(false, first_index(kPolygonKind) + i);
}

bool has_shape(const PolygonOrPortal light) { return !light.is_environment || has_portal(light.index); }

/// What passes a portal. \param shape in shading space, \param index among the environments
LocalPolygon local_portal(const Surface surface, const ConvexPolygon shape, uint index) {
    LocalPolygon light;
    light.shape = shape;
    // A map is looked up in the direction of each sample.
    bool is_mapped = environment_lights[index].first_map_word != kNoWords;
    // Comparisons with NaN are false: negated they keep it, so that it is counted.
    light.role = LightRole(!(highest_vertex(shape) <= 0.0),
                           is_mapped ? vec3(1.0) : to_vec(environment_lights[index].radiance),
                           light_number(kEnvironmentKind, index));
    light.environment = int(index);
    light.shading = surface.shading;
    light.texture_number = -1;
    light.profile = kNoWords;
    return light;
}

/// \param light for which has_shape() holds
LocalPolygon local_polygon_or_portal(const Surface surface, const PolygonOrPortal light) {
    uint index = light.index;
    uint first_word;
    vec3 normal;
    if (light.is_environment) {
        first_word = environment_lights[index].first_corner_word;
        normal = to_vec(environment_lights[index].normal);
    } else {
        first_word = polygon_lights[index].first_corner_word;
        normal = to_vec(polygon_lights[index].normal);
    }
    ConvexPolygon shape = to_shading_space(stored_polygon(first_word, normal), surface.position, surface.shading);
    if (light.is_environment) return local_portal(surface, shape, index);
    return local_polygon(surface, shape, index);
}

#endif
