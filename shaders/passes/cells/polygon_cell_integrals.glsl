#ifndef NUSSELT_PASSES_CELLS_POLYGON_CELL_INTEGRALS_GLSL
#define NUSSELT_PASSES_CELLS_POLYGON_CELL_INTEGRALS_GLSL
/// Integrals over polygonal lights, some of which emit an image: all of each cell has its mean radiance.

#include "passes/cells/polygon_cells.glsl"

void add_polygon(inout Reflected reflected, const LocalPolygon light) {
    if (!kHasTexturedPolygons || light.texture_number < 0) {
        if (kHasPolygons || kHasPortals) add_light(reflected, light.role, lobe_integrals(light.shape, reflected.glossy.lobe));
        return;
    }
    bool is_glossy = glossy_surface_is_glossy(reflected.glossy);
    PolygonCells cells = prepare_cells(light, reflected.glossy.lobe, is_glossy);
    vec3 share = cells_unshadowed(cells, 0) * reflected.glossy.diffuse_albedo;
    if (is_glossy) share += cells_unshadowed(cells, 1) * reflected.glossy.specular_albedo;
    add_share(reflected, vec3(1.0), share);
}

#endif
