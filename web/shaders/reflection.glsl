#ifndef PAGE_REFLECTION_GLSL
#define PAGE_REFLECTION_GLSL
/// The BRDF of a shading point, and the lobe that fits its specular part.

#include "nusselt/bsdf/lambert.glsl"
#include "specular_fit.glsl"
#include "surface.glsl"

struct Reflection {
    bool is_frostbite; ///< if not, Lambert
    Lambert lambert;
    GlossySurface glossy; ///< with a specular albedo of 0 where there is no lobe
};

/// \param fit of the specular part.
Reflection reflection_with(Surface surface, SpecularFit fit) {
    Material material = surface.material;
    Reflection self;
    self.is_frostbite = material.model == kFrostbite;
    self.lambert = Lambert(material.diffuse);
    self.glossy = make_glossy_surface(surface.cos_o, material.diffuse, material.f0, material.roughness, fit);
    if (!self.is_frostbite) self.glossy.diffuse_albedo = material.diffuse;
    return self;
}

SpecularFit no_fit() { return SpecularFit(ltc_prepare(LtcCoefficients(1.0, 0.0, 1.0, 0.0, 1.0, 0.0)), vec3(0.0)); }

/// For techniques that use the BRDF only. Its lobe and albedos mean nothing.
Reflection brdf_of(Surface surface) { return reflection_with(surface, no_fit()); }

/// With the lobe of the specular part.
Reflection brdf_and_lobe_of(Surface surface) {
    SpecularFit fit = no_fit();
    Material material = surface.material;
    if (material.model == kFrostbite) fit = specular_fit(material.roughness, surface.cos_o, material.f0);
    return reflection_with(surface, fit);
}

BrdfComponents reflection_eval_components(Reflection self, vec3 wi) {
    if (self.is_frostbite) return frostbite_eval_components(self.glossy.brdf, wi);
    return lambert_eval_components(self.lambert, wi);
}

#endif
