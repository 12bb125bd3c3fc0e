#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_INTEGRALS_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_INTEGRALS_GLSL
/// Integrates over all polygonal lights.

#include "nusselt/ltc/polygon_shading.glsl"
#include "passes/lights/polygon.glsl"

void add_polygons(inout Reflected reflected) {
    for (uint i = first_index(kPolygonKind); kHasPolygons && i < end_index(kPolygonKind); ++i) {
        LocalPolygon light = local_polygon(reflected.surface, i);
        if (!light.role.is_lit) continue;
        add_light(reflected, light.role,
                  vec2(diffuse_integral(light.shape), clipped_lobe_integral(light.shape, reflected.glossy.lobe)));
    }
}

#endif
