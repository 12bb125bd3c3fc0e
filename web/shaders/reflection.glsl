#ifndef PAGE_REFLECTION_GLSL
#define PAGE_REFLECTION_GLSL
/// The BRDF of a shading point, and the lobe that fits its specular part.

#include "nusselt/bsdf/lambert.glsl"
#include "surface.glsl"

/// data/ltc-frostbite-engine.bin: the inclination along x, the roughness along y.
uniform highp sampler2D lobe_shapes;
uniform highp sampler2D lobe_albedos;

struct Reflection {
    bool is_frostbite; ///< if not, Lambert
    Lambert lambert;
    GlossySurface glossy; ///< with a specular albedo of 0 where there is no lobe
};

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

/// \param uses_lobes whether the fit of the specular part is needed.
Reflection reflection_of(Surface surface, bool uses_lobes) {
    Material material = surface.material;
    Reflection self;
    self.is_frostbite = material.model == kFrostbite;
    self.lambert = Lambert(material.diffuse);
    SpecularFit fit = SpecularFit(ltc_prepare(LtcCoefficients(1.0, 0.0, 1.0, 0.0, 1.0, 0.0)), vec3(0.0));
    if (uses_lobes && self.is_frostbite) fit = specular_fit(material.roughness, surface.cos_o, material.f0);
    self.glossy = make_glossy_surface(surface.cos_o, material.diffuse, material.f0, material.roughness, fit);
    if (!self.is_frostbite) self.glossy.diffuse_albedo = material.diffuse;
    return self;
}

BrdfComponents reflection_eval_components(Reflection self, vec3 wi) {
    if (self.is_frostbite) return frostbite_eval_components(self.glossy.brdf, wi);
    return lambert_eval_components(self.lambert, wi);
}

#endif
