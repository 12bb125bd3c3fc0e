#ifndef NUSSELT_PASSES_LIGHTS_LINE_INTEGRALS_GLSL
#define NUSSELT_PASSES_LIGHTS_LINE_INTEGRALS_GLSL
/// Integrates over all linear lights, strips and tubes.

#include "nusselt/ltc/line_shading.glsl"
#include "passes/lights/line.glsl"

void add_lines(inout Reflected reflected) {
    for (uint i = first_index(kLineKind); (kHasLines || kHasTubes) && i < end_index(kLineKind); ++i) {
        LocalLine light = local_line(reflected.surface, i);
        if (!light.role.is_lit) continue;
        vec2 integrals =
            vec2(diffuse_integral(light.shape), clipped_lobe_integral(light.shape, reflected.glossy.lobe));
        if (kHasTubes && is_tube(light)) {
            vec2 caps = vec2(0.0);
            if (light.model == kSolidTube)
                caps = vec2(diffuse_caps_integral(light.shape, light.radius),
                            clipped_caps_integral(light.shape, light.radius, reflected.glossy.lobe));
            integrals = vec2(tube_integral(integrals.x, light.radius, caps.x),
                             tube_integral(integrals.y, light.radius, caps.y));
        }
        add_light(reflected, light.role, integrals);
    }
}

#endif
