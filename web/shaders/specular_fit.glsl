#ifndef PAGE_SPECULAR_FIT_GLSL
#define PAGE_SPECULAR_FIT_GLSL
/// The lobe that fits the specular part of a BRDF, from the table in textures.

#include "nusselt/estimate/surface.glsl"

/// data/ltc-frostbite-engine.bin: the inclination along x, the roughness along y.
uniform highp sampler2D lobe_shapes;
uniform highp sampler2D lobe_albedos;

SpecularFit specular_fit(float roughness, float cos_o, vec3 f0) {
    LtcTableCell cell = ltc_table_cell(roughness, cos_o, 0.0, ivec3(2, textureSize(lobe_shapes, 0)));
    LtcTableEntry sum = LtcTableEntry(vec3(0.0), vec3(0.0));
    vec2 albedo = vec2(0.0);
    for (int corner = 0; corner < 8; corner += 2) {
        ivec2 at = ltc_table_corner(cell, corner).yz;
        float weight = ltc_table_weight(cell, corner);
        vec2 entry_albedo = texelFetch(lobe_albedos, at, 0).xy;
        ltc_table_add(sum, weight, ltc_engine_table_entry(texelFetch(lobe_shapes, at, 0), entry_albedo, mean_f0(f0)));
        albedo += weight * entry_albedo;
    }
    return fit_of(sum, albedo.y, albedo.x + albedo.y, f0);
}

#endif
