#ifndef NUSSELT_PASSES_LIGHTS_LINE_INTEGRALS_GLSL
#define NUSSELT_PASSES_LIGHTS_LINE_INTEGRALS_GLSL
/// Integrates over all linear lights, strips and tubes.

#include "nusselt/ltc/line_shading.glsl"
#include "passes/lights/line.glsl"

/// The integrals of the diffuse and the specular lobe over the axis of a light, per radius.
vec2 axis_integrals(const LocalLine light, const Ltc lobe) {
    return vec2(diffuse_integral(light.shape), clipped_lobe_integral(light.shape, lobe));
}

/// The same over the caps of a tube.
vec2 caps_integrals(const LocalLine light, const Ltc lobe) {
    if (light.model != kSolidTube) return vec2(0.0);
    return vec2(diffuse_caps_integral(light.shape, light.radius),
                clipped_caps_integral(light.shape, light.radius, lobe));
}

/// Adds a light of uniform radiance.
void add_uniform_line(inout Reflected reflected, const LocalLine light) {
    vec2 integrals = axis_integrals(light, reflected.glossy.lobe);
    if (kHasTubes && is_tube(light)) {
        vec2 caps = caps_integrals(light, reflected.glossy.lobe);
        integrals = vec2(tube_integral(integrals.x, light.radius, caps.x),
                         tube_integral(integrals.y, light.radius, caps.y));
    }
    add_light(reflected, light.role, integrals);
}

#if LINE_CELLS
#include "passes/cells/line_cell_integrals.glsl"
#else
void add_line(inout Reflected reflected, const LocalLine light) { add_uniform_line(reflected, light); }
#endif

void add_lines(inout Reflected reflected) {
    for (uint i = first_index(kLineKind); (kHasAnyLines || kHasAnyTubes) && i < end_index(kLineKind); ++i) {
        LocalLine light = local_line(reflected.surface, i);
        if (light.role.is_lit) add_line(reflected, light);
    }
}

#endif
