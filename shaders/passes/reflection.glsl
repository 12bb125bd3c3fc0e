#ifndef NUSSELT_PASSES_REFLECTION_GLSL
#define NUSSELT_PASSES_REFLECTION_GLSL
/// The BRDF of a shading point, and the lobe that fits its specular component.

#include "nusselt/bsdf/lambert.glsl"
#include "nusselt/estimate/surface.glsl"
#include "passes/settings.glsl"
#include "passes/surface.glsl"

/// Decoded samples of the table of the specular Frostbite BRDF, six floats for each.
layout(set = 0, binding = kFirstBindingAfterLights, std430) readonly buffer LtcTable { float ltc_table[]; };

struct Reflection {
    bool is_frostbite; ///< otherwise Lambert
    Lambert lambert;
    GlossySurface glossy; ///< with a specular albedo of 0 where the surface has no lobe or the settings use none
};

BrdfComponents reflection_eval_components(Reflection self, vec3 wi) {
    if (self.is_frostbite) return frostbite_eval_components(self.glossy.brdf, wi);
    return lambert_eval_components(self.lambert, wi);
}

vec3 reflection_eval(Reflection self, vec3 wi) {
    return self.is_frostbite ? frostbite_eval(self.glossy.brdf, wi) : lambert_eval(self.lambert, wi);
}

LtcTableEntry ltc_entry(ivec3 at, ivec3 samples) {
    int begin = 6 * ltc_table_index(at, samples);
    return LtcTableEntry(vec3(ltc_table[begin], ltc_table[begin + 1], ltc_table[begin + 2]),
                         vec3(ltc_table[begin + 3], ltc_table[begin + 4], ltc_table[begin + 5]));
}

float ltc_albedo(ivec3 at, ivec3 samples) { return ltc_table[6 * ltc_table_index(at, samples) + 5]; }

SpecularFit look_up_fit(float roughness, float cos_o, vec3 f0) {
    ivec3 samples = ivec3(scene.ltc_samples[0], scene.ltc_samples[1], scene.ltc_samples[2]);
    LtcTableCell cell = ltc_table_cell(roughness, cos_o, mean_f0(f0), samples);
    LtcTableEntry sum = LtcTableEntry(vec3(0.0), vec3(0.0));
    float of_black = 0.0;
    float of_white = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 at = ltc_table_corner(cell, corner);
        float weight = ltc_table_weight(cell, corner);
        ltc_table_add(sum, weight, ltc_entry(at, samples));
        of_black += weight * ltc_albedo(ivec3(0, at.yz), samples);
        of_white += weight * ltc_albedo(ivec3(samples.x - 1, at.yz), samples);
    }
    return fit_of(sum, of_black, of_white, f0);
}

Reflection make_reflection(Surface surface) {
    Reflection self;
    self.is_frostbite = kHasFrostbite && kBrdf != kBrdfLambert && surface.is_frostbite;
    self.lambert = Lambert(surface.diffuse);
    self.glossy.wo = surface.wo;
    self.glossy.alpha = ggx_alpha(surface.roughness);
    self.glossy.brdf = frostbite_prepare(surface.wo, surface.diffuse, surface.f0, surface.roughness);
    bool uses_lobes = kStrategies != kStrategiesDiffuse || kTechnique == kTechniqueLtcAnalytic;
    if (uses_lobes && self.is_frostbite) {
        SpecularFit fit = look_up_fit(surface.roughness, surface.wo.z, surface.f0);
        self.glossy.lobe = fit.lobe;
        self.glossy.diffuse_albedo = frostbite_diffuse_albedo(self.glossy.brdf);
        self.glossy.specular_albedo = fit.albedo;
    } else {
        self.glossy.lobe = ltc_prepare(LtcCoefficients(1.0, 0.0, 1.0, 0.0, 1.0, 0.0));
        self.glossy.diffuse_albedo = surface.diffuse;
        self.glossy.specular_albedo = vec3(0.0);
    }
    return self;
}

#endif
