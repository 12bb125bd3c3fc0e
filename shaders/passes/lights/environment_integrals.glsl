#ifndef NUSSELT_PASSES_LIGHTS_ENVIRONMENT_INTEGRALS_GLSL
#define NUSSELT_PASSES_LIGHTS_ENVIRONMENT_INTEGRALS_GLSL
/// Integrals over all environments without a portal, in the shaders that scenes with such lights have. Each cell of a
/// map has its mean radiance; all of a lobe counts, as if it were above the horizon. Those over portals are in
/// polygon_integrals.glsl.

#if EMISSION_CELLS
#include "passes/cells/environment_cells.glsl"

void add_environments(inout Reflected reflected) {
    bool is_glossy = glossy_surface_is_glossy(reflected.glossy);
    for (uint i = first_index(kEnvironmentKind); kHasSkies && i < end_index(kEnvironmentKind); ++i) {
        if (has_portal(i)) continue;
        Sky sky = prepare_sky(i, reflected.surface.shading, reflected.glossy.lobe, is_glossy);
        vec3 share = cells_unshadowed(sky, 0) * reflected.glossy.diffuse_albedo;
        if (is_glossy) share += cells_unshadowed(sky, 1) * reflected.glossy.specular_albedo;
        add_share(reflected, has_map(sky) ? vec3(1.0) : to_vec(environment_lights[i].radiance), share);
    }
}
#else
void add_environments(inout Reflected reflected) {}
#endif

#endif
