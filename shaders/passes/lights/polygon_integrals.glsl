#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_INTEGRALS_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_INTEGRALS_GLSL
/// Integrates over all polygonal lights.

#include "nusselt/ltc/polygon_shading.glsl"
#include "passes/lights/polygon.glsl"

vec2 lobe_integrals(LocalPolygon light, Ltc lobe) {
    return vec2(diffuse_integral(light.shape), clipped_lobe_integral(light.shape, lobe));
}

#if EMISSION_CELLS
#include "passes/cells/polygon_cell_integrals.glsl"
#else
#include "passes/lights/polygon_uniform_integrals.glsl"
#endif

void add_polygons(inout Reflected reflected) {
    for (uint i = first_index(kPolygonKind); kHasAnyPolygons && i < end_index(kPolygonKind); ++i) {
        LocalPolygon light = local_polygon(reflected.surface, i);
        if (light.role.is_lit) add_polygon(reflected, light);
    }
}

#endif
