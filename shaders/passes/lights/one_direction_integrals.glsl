#ifndef NUSSELT_PASSES_LIGHTS_ONE_DIRECTION_INTEGRALS_GLSL
#define NUSSELT_PASSES_LIGHTS_ONE_DIRECTION_INTEGRALS_GLSL
/// What analytic shading knows of lights without extent: the densities of both lobes in their direction.

#include "passes/lights/distant.glsl"
#include "passes/lights/point.glsl"

void add_direction(inout Reflected reflected, const OneDirection light) {
    if (!light.role.is_lit) return;
    vec2 lobes = vec2((1.0 / kNusseltPi) * light.wi.z, ltc_density(reflected.glossy.lobe, light.wi));
    add_light(reflected, light.role, lobes);
}

void add_points(inout Reflected reflected) {
    for (uint i = first_index(kPointKind); kHasAnyPoints && i < end_index(kPointKind); ++i)
        add_direction(reflected, local_point(reflected.surface, i));
}

void add_distants(inout Reflected reflected) {
    for (uint i = first_index(kDistantKind); kHasDistants && i < end_index(kDistantKind); ++i)
        add_direction(reflected, local_distant(reflected.surface, i));
}

#endif
