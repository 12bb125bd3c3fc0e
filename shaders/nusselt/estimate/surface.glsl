#ifndef NUSSELT_ESTIMATE_SURFACE_GLSL
#define NUSSELT_ESTIMATE_SURFACE_GLSL
// Follows include/nusselt/estimate/surface.h @ ce851e791f49
/// Data of a point of a surface that does not depend on the lights. Twin of include/nusselt/estimate/surface.h.

#include "../bsdf/frostbite.glsl"
#include "../bsdf/phong.glsl"
#include "../ltc/ltc.glsl"
#include "../ltc/table.glsl"

/// A point of a surface as seen from one direction, in shading space with wo in the xz half-plane (shading_frame()),
/// with the Frostbite BRDF.
struct GlossySurface {
    vec3 wo;     ///< unit direction to the eye
    float alpha; ///< of GGX
    Frostbite brdf;
    Ltc lobe;             ///< fit of the specular component times cosine
    vec3 diffuse_albedo;  ///< estimates of the directional albedo of both components, at least 0
    vec3 specular_albedo; ///< 0 where there is no specular component: its technique is then left out
};

/// Whether there is a specular component.
bool is_glossy(vec3 specular_albedo) {
    return nusselt_max(nusselt_max(specular_albedo.x, specular_albedo.y), specular_albedo.z) > 0.0;
}
bool glossy_surface_is_glossy(const GlossySurface self) { return is_glossy(self.specular_albedo); }

/// The fit of a specular component by a table.
struct SpecularFit {
    Ltc lobe;
    vec3 albedo;
};

/// One lobe has to do for all colour channels: it is looked up with the mean of f0.
float mean_f0(vec3 f0) { return (f0.x + f0.y + f0.z) * (1.0 / 3.0); }

/// \param sum                of the eight neighbours, looked up with mean_f0(f0).
/// \param of_black, of_white see ltc_table_albedo().
SpecularFit fit_of(const LtcTableEntry sum, float of_black, float of_white, vec3 f0) {
    return SpecularFit(ltc_prepare(ltc_table_coefficients(sum)), ltc_table_albedo(of_black, of_white, f0));
}

/// The same for a Phong lobe.
/// \param sum    of the eight neighbours, looked up with sqrt(phong_alpha(exponent)) and f0 = 0.
/// \param albedo of the lobe at normal incidence.
SpecularFit phong_fit_of(const LtcTableEntry sum, vec3 albedo) {
    LtcCoefficients fit = ltc_table_coefficients(sum);
    return SpecularFit(ltc_prepare(fit), fit.albedo * albedo);
}

/// A surface with the Frostbite BRDF.
/// \param cos_o     cosine between the normal and the direction to the eye. Below the horizon the surface is black.
/// \param albedo    of the diffuse part, in [0, 1].
/// \param f0        reflectance of the specular part at normal incidence, in [0, 1].
/// \param roughness perceptual, in [0, 1].
/// \param fit       of the specular Frostbite BRDF at roughness, cos_o and f0.
GlossySurface make_glossy_surface(float cos_o, vec3 albedo, vec3 f0, float roughness, const SpecularFit fit) {
    float sin_o = sqrt(nusselt_max((1.0 - cos_o) * (1.0 + cos_o), 0.0));
    vec3 wo = vec3(sin_o, 0.0, cos_o);
    Frostbite brdf = frostbite_prepare(wo, albedo, f0, roughness);
    return GlossySurface(wo, ggx_alpha(roughness), brdf, fit.lobe, frostbite_diffuse_albedo(brdf), fit.albedo);
}

#endif
