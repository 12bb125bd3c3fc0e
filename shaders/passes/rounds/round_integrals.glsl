#ifndef NUSSELT_PASSES_ROUNDS_ROUND_INTEGRALS_GLSL
#define NUSSELT_PASSES_ROUNDS_ROUND_INTEGRALS_GLSL
/// Integrates over all spheres, disks, ellipses and ellipsoids.

#include "passes/rounds/round.glsl"

#if ROUND_LIGHTS
#include "nusselt/cones/cone_shading.glsl"

/// The integral of the lobe that a view has the cone of.
float lobe_integral(const RoundLightView view) {
    return nusselt_min((1.0 / kNusseltPi) * projected_solid_angle(view.cone), 1.0);
}

void add_rounds(inout Reflected reflected) {
    for (uint i = first_index(kRoundKind); kHasRounds && i < end_index(kRoundKind); ++i) {
        LocalRound light = local_round(reflected.surface, i);
        if (!light.role.is_lit) continue;
        float diffuse = lobe_integral(view_of(light.shape));
        float specular = 0.0;
        if (glossy_surface_is_glossy(reflected.glossy))
            specular = lobe_integral(view_of(light.shape, reflected.glossy.lobe));
        add_light(reflected, light.role, vec2(diffuse, specular));
    }
}
#else
void add_rounds(inout Reflected reflected) {}
#endif

#endif
