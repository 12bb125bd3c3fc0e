#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_INTEGRALS_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_INTEGRALS_GLSL
/// Integrates over all polygonal lights and portals without a map.

#include "nusselt/ltc/polygon_shading.glsl"
#include "passes/lights/portal.glsl"

vec2 lobe_integrals(const ConvexPolygon light, const Ltc lobe) {
    return vec2(diffuse_integral(light), clipped_lobe_integral(light, lobe));
}

#if EMISSION_CELLS
#include "passes/cells/polygon_cell_integrals.glsl"
#else
#include "passes/lights/polygon_uniform_integrals.glsl"
#endif

void add_polygons(inout Reflected reflected) {
    for (uint i = 0u; (kHasAnyPolygons || kHasPortals) && i < polygon_or_portal_count(); ++i) {
        PolygonOrPortal candidate = polygon_or_portal(i);
        if (!has_shape(candidate)) continue;
        LocalPolygon light = local_polygon_or_portal(reflected.surface, candidate);
        if (light.role.is_lit) add_polygon(reflected, light);
    }
}

#endif
