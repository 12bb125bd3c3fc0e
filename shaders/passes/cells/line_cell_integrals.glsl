#ifndef NUSSELT_PASSES_CELLS_LINE_CELL_INTEGRALS_GLSL
#define NUSSELT_PASSES_CELLS_LINE_CELL_INTEGRALS_GLSL
/// Integrals over lines and tubes whose radiance varies along them: all of each cell has its mean radiance.

#include "passes/cells/line_cells.glsl"

/// The light of a tube without a profile, times the mean of radiance that its cells and the cap that is seen have.
/// \param by_cells what cells of its axis reflect, per radius
vec3 tube_share(float along_axis, float caps, float radius, vec3 by_cells, vec3 on_cap) {
    float side = along_axis * radius;
    float both = side + caps;
    if (!(both > 0.0)) return vec3(0.0);
    return tube_integral(along_axis, radius, caps) / both * (radius * by_cells + caps * on_cap);
}

void add_line(inout Reflected reflected, const LocalLine light) {
    if (!varies(light.radiance)) {
        if (kHasLines || kHasTubes) add_uniform_line(reflected, light);
        return;
    }
    bool is_glossy = glossy_surface_is_glossy(reflected.glossy);
    Ltc lobe = reflected.glossy.lobe;
    LineLightCells cells = prepare_cells(light, lobe, is_glossy);
    vec3 diffuse = cells_unshadowed(cells, 0);
    vec3 specular = vec3(0.0);
    if (is_glossy) specular = cells_unshadowed(cells, 1);
    if (kHasTexturedTubes && is_tube(light)) {
        bool sees_start = dot(light.shape.p0, light.shape.s) > 0.0;
        vec3 on_cap = line_profile_lookup(light.radiance.profile, sees_start ? 0.0 : 1.0);
        vec2 axis = axis_integrals(light, lobe);
        vec2 caps = caps_integrals(light, lobe);
        diffuse = tube_share(axis.x, caps.x, light.radius, diffuse, on_cap);
        if (is_glossy) specular = tube_share(axis.y, caps.y, light.radius, specular, on_cap);
    }
    add_share(reflected, vec3(light.width),
              diffuse * reflected.glossy.diffuse_albedo + specular * reflected.glossy.specular_albedo);
}

#endif
