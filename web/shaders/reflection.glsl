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
