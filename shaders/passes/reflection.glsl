#ifndef NUSSELT_PASSES_REFLECTION_GLSL
#define NUSSELT_PASSES_REFLECTION_GLSL
/// The BRDF of a shading point, and the lobe that fits its specular component.

#include "nusselt/bsdf/lambert.glsl"
#include "nusselt/estimate/surface.glsl"
#include "passes/settings.glsl"
#include "passes/surface.glsl"

/// Decoded samples of the tables of the specular Frostbite BRDF and of Phong lobes, six floats for each.
layout(set = 0, binding = kFirstBindingAfterLights, std430) readonly buffer LtcTable { float ltc_table[]; };

struct Reflection {
    bool is_frostbite;
    bool is_phong; ///< if neither, Lambert
    Lambert lambert; ///< also the diffuse component of Phong surfaces
    Phong phong;
    GlossySurface glossy; ///< with a specular albedo of 0 where the surface has no lobe or the settings use none
};

BrdfComponents reflection_eval_components(const Reflection self, vec3 wi) {
    if (self.is_frostbite) return frostbite_eval_components(self.glossy.brdf, wi);
    if (self.is_phong) return lambert_phong_eval_components(self.lambert, self.phong, wi);
    return lambert_eval_components(self.lambert, wi);
}

vec3 reflection_eval(const Reflection self, vec3 wi) {
    if (self.is_frostbite) return frostbite_eval(self.glossy.brdf, wi);
    vec3 value = lambert_eval(self.lambert, wi);
    if (self.is_phong) value += phong_eval(self.phong, wi);
    return value;
}

/// A table in the buffer.
struct LobeTable {
    int first; ///< number of its first sample
    ivec3 samples;
};

LobeTable frostbite_lobes() {
    return LobeTable(0, ivec3(scene.frostbite_lobe_samples[0], scene.frostbite_lobe_samples[1],
                              scene.frostbite_lobe_samples[2]));
}

LobeTable phong_lobes() {
    ivec3 before = frostbite_lobes().samples;
    return LobeTable(before.x * before.y * before.z, ivec3(scene.phong_lobe_samples[0], scene.phong_lobe_samples[1],
                                                           scene.phong_lobe_samples[2]));
}

LtcTableEntry ltc_entry(ivec3 at, const LobeTable table) {
    int begin = 6 * (table.first + ltc_table_index(at, table.samples));
    return LtcTableEntry(vec3(ltc_table[begin], ltc_table[begin + 1], ltc_table[begin + 2]),
                         vec3(ltc_table[begin + 3], ltc_table[begin + 4], ltc_table[begin + 5]));
}

float ltc_albedo(ivec3 at, const LobeTable table) {
    return ltc_table[6 * (table.first + ltc_table_index(at, table.samples)) + 5];
}

SpecularFit look_up_frostbite_fit(float roughness, float cos_o, vec3 f0) {
    LobeTable table = frostbite_lobes();
    LtcTableCell cell = ltc_table_cell(roughness, cos_o, mean_f0(f0), table.samples);
    LtcTableEntry sum = LtcTableEntry(vec3(0.0), vec3(0.0));
    float of_black = 0.0;
    float of_white = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 at = ltc_table_corner(cell, corner);
        float weight = ltc_table_weight(cell, corner);
        ltc_table_add(sum, weight, ltc_entry(at, table));
        of_black += weight * ltc_albedo(ivec3(0, at.yz), table);
        of_white += weight * ltc_albedo(ivec3(table.samples.x - 1, at.yz), table);
    }
    return fit_of(sum, of_black, of_white, f0);
}

SpecularFit look_up_phong_fit(float exponent, float cos_o, vec3 albedo) {
    LobeTable table = phong_lobes();
    LtcTableCell cell = ltc_table_cell(sqrt(phong_alpha(exponent)), cos_o, 0.0, table.samples);
    LtcTableEntry sum = LtcTableEntry(vec3(0.0), vec3(0.0));
    for (int corner = 0; corner < 8; ++corner)
        ltc_table_add(sum, ltc_table_weight(cell, corner), ltc_entry(ltc_table_corner(cell, corner), table));
    return phong_fit_of(sum, albedo);
}

Reflection make_reflection(const Surface surface) {
    Reflection self;
    self.is_frostbite = kHasFrostbite && kBrdf != kBrdfLambert && surface.model == kModelFrostbite;
    self.is_phong = kHasPhong && kBrdf != kBrdfLambert && surface.model == kModelPhong;
    self.lambert = Lambert(surface.diffuse);
    self.phong = phong_prepare(surface.wo, surface.f0, surface.exponent);
    self.glossy.wo = surface.wo;
    self.glossy.alpha = self.is_phong ? phong_alpha(surface.exponent) : ggx_alpha(surface.roughness);
    self.glossy.brdf = frostbite_prepare(surface.wo, surface.diffuse, surface.f0, surface.roughness);
    self.glossy.lobe = ltc_prepare(LtcCoefficients(1.0, 0.0, 1.0, 0.0, 1.0, 0.0));
    self.glossy.diffuse_albedo = surface.diffuse;
    self.glossy.specular_albedo = vec3(0.0);
    bool uses_lobes = kStrategies != kStrategiesDiffuse || kTechnique == kTechniqueLtcAnalytic;
    if (uses_lobes && self.is_frostbite) {
        SpecularFit fit = look_up_frostbite_fit(surface.roughness, surface.wo.z, surface.f0);
        self.glossy.lobe = fit.lobe;
        self.glossy.diffuse_albedo = frostbite_diffuse_albedo(self.glossy.brdf);
        self.glossy.specular_albedo = fit.albedo;
    }
    if (uses_lobes && self.is_phong) {
        SpecularFit fit = look_up_phong_fit(surface.exponent, surface.wo.z, surface.f0);
        self.glossy.lobe = fit.lobe;
        self.glossy.specular_albedo = fit.albedo;
    }
    return self;
}

#endif
