#ifndef NUSSELT_BSDF_FROSTBITE_GLSL
#define NUSSELT_BSDF_FROSTBITE_GLSL
// Follows include/nusselt/bsdf/frostbite.h @ 7240170aa5c4
/// The Frostbite BRDF: Disney diffuse, renormalised, plus GGX with height-correlated Smith and Schlick.
///
/// S. Lagarde, C. de Rousiers 2014, Moving Frostbite to Physically Based Rendering, SIGGRAPH course, Sec. 3.1. Twin of
/// include/nusselt/bsdf/frostbite.h, where the formulas and bounds stand.
///
/// All directions are unit vectors in shading space, pointing away from the surface; z is the cosine. Values are those
/// of the BRDF, without the cosine [1/sr]. They are 0 where wi.z <= 0 or wo.z <= 0, and never NaN.

#include "../bsdf/components.glsl"
#include "../bsdf/ggx.glsl"

/// Smallest denominator of the visibility term.
const float kNusseltSmallestVisibilityDenominator = 1e-20;

/// One surface point seen from one direction.
struct Frostbite {
    vec3 wo;
    vec3 f0;
    vec3 diffuse; ///< albedo with all factors that do not depend on directions
    float roughness;
    float alpha2;
    float slant_o;
    float grazing_o; ///< (1 - wo.z)^5
};

/// wo + wi has twice the length of the cosine between each of them and the half vector.
struct FrostbiteHalfVector {
    vec3 sum;   ///< of wo and wi
    float cos2; ///< squared cosine between the half vector and either direction
};

FrostbiteHalfVector frostbite_half_vector(vec3 sum) {
    return FrostbiteHalfVector(sum, nusselt_min(0.25 * dot(sum, sum), 1.0));
}

float fifth_power_of_complement(float x) {
    float y = nusselt_max(1.0 - x, 0.0);
    float y2 = y * y;
    return y2 * y2 * y;
}

/// The root in the Smith terms.
float frostbite_slant(float cosine, float alpha2) { return sqrt(cosine * cosine * (1.0 - alpha2) + alpha2); }

/// \param wo        unit direction to the eye; parallel to the normal is fine.
/// \param albedo    of the diffuse part, in [0, 1].
/// \param f0        reflectance of the specular part at normal incidence, in [0, 1].
/// \param roughness perceptual ("linear") roughness, clamped to [0, 1]; the alpha of GGX is ggx_alpha() of it.
Frostbite frostbite_prepare(vec3 wo, vec3 albedo, vec3 f0, float roughness) {
    float clamped = nusselt_min(nusselt_max(roughness, 0.0), 1.0);
    float alpha = ggx_alpha(clamped);
    float alpha2 = alpha * alpha;
    // The factor E_f of Lagarde and de Rousiers goes from 1 to 1 / 1.51.
    float energy = 1.0 - clamped * (1.0 - 1.0 / 1.51);
    return Frostbite(wo, f0, (energy * (1.0 / kNusseltPi)) * albedo, clamped, alpha2, frostbite_slant(wo.z, alpha2),
                     fifth_power_of_complement(wo.z));
}

/// F90 - 1.
/// \param cos2 squared cosine between the half vector and either direction.
float frostbite_retroreflection(const Frostbite self, float cos2) { return self.roughness * (0.5 + 2.0 * cos2) - 1.0; }

vec3 frostbite_diffuse(const Frostbite self, vec3 wi, const FrostbiteHalfVector h) {
    if (!(self.wo.z > 0.0 && wi.z > 0.0)) return vec3(0.0);
    float bias = frostbite_retroreflection(self, h.cos2);
    float scatter_i = 1.0 + bias * fifth_power_of_complement(wi.z);
    float scatter_o = 1.0 + bias * self.grazing_o;
    return (scatter_i * scatter_o) * self.diffuse;
}

vec3 frostbite_specular(const Frostbite self, vec3 wi, const FrostbiteHalfVector h) {
    if (!(self.wo.z > 0.0 && wi.z > 0.0)) return vec3(0.0);
    float distribution = ggx_distribution(ggx_ratio(h.sum, self.alpha2), self.alpha2);
    float denominator = wi.z * self.slant_o + self.wo.z * frostbite_slant(wi.z, self.alpha2);
    float visibility = 0.5 / nusselt_max(denominator, kNusseltSmallestVisibilityDenominator);
    float grazing = fifth_power_of_complement(sqrt(h.cos2));
    return (distribution * visibility) * (self.f0 + (vec3(1.0) - self.f0) * grazing);
}

BrdfComponents frostbite_eval_components(const Frostbite self, vec3 wi) {
    FrostbiteHalfVector h = frostbite_half_vector(self.wo + wi);
    return BrdfComponents(frostbite_diffuse(self, wi, h), frostbite_specular(self, wi, h));
}

vec3 frostbite_eval(const Frostbite self, vec3 wi) {
    BrdfComponents components = frostbite_eval_components(self, wi);
    return components.diffuse + components.specular;
}

/// Estimate of the directional albedo of the diffuse part, for coefficients of multiple importance sampling: off by at
/// most 5 %. The half vector is taken to be at 45 degrees from either direction.
vec3 frostbite_diffuse_albedo(const Frostbite self) {
    float bias = frostbite_retroreflection(self, 0.5);
    // The mean of (1 - wi.z)^5 under the cosine is 1 / 21.
    float scatter = (1.0 + bias * (1.0 / 21.0)) * (1.0 + bias * self.grazing_o);
    return (kNusseltPi * scatter) * self.diffuse;
}

/// The diffuse part of frostbite_eval().
vec3 frostbite_eval_diffuse(const Frostbite self, vec3 wi) {
    return frostbite_diffuse(self, wi, frostbite_half_vector(self.wo + wi));
}

/// The specular part of frostbite_eval().
vec3 frostbite_eval_specular(const Frostbite self, vec3 wi) {
    return frostbite_specular(self, wi, frostbite_half_vector(self.wo + wi));
}

#endif
