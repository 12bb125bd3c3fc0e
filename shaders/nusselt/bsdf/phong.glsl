#ifndef NUSSELT_BSDF_PHONG_GLSL
#define NUSSELT_BSDF_PHONG_GLSL
// Follows include/nusselt/bsdf/phong.h @ 0c9ba0e2cbbe
/// The Phong BRDF: a power of the cosine with the mirrored direction. Twin of include/nusselt/bsdf/phong.h.

#include "../bsdf/lambert.glsl"
#include "../core/exponential.glsl"
#include "../core/vec.glsl"

/// Factor of the lobe such that its cosine-weighted integral is 1 at normal incidence [1/sr].
float phong_normalisation(float exponent) { return (exponent + 2.0) * (0.5 / kNusseltPi); }

/// The alpha of a Beckmann distribution whose reflections are as wide.
float phong_alpha(float exponent) { return 1.0 / sqrt(nusselt_fma(2.0, exponent, 1.0)); }

struct Phong {
    vec3 mirror; ///< the direction to the eye, mirrored at the surface; the maximum of the lobe
    vec3 albedo;
    float exponent;
};

/// \param wo       unit direction to the eye in shading space.
/// \param albedo   per colour channel, in [0, 1].
/// \param exponent at least 0; any real number.
Phong phong_prepare(vec3 wo, vec3 albedo, float exponent) {
    return Phong(vec3(-wo.x, -wo.y, wo.z), albedo, exponent);
}

/// The BRDF, without the cosine [1/sr].
/// \param wi unit direction to the light in shading space; 0 where wi.z <= 0 or wo.z <= 0.
vec3 phong_eval(const Phong self, vec3 wi) {
    // The cross product keeps the precision that the cosine loses for narrow lobes.
    vec3 across = nusselt_cross(self.mirror, wi);
    float cosine = dot(self.mirror, wi);
    if (!(wi.z > 0.0) || !(self.mirror.z > 0.0) || !(cosine > 0.0)) return vec3(0.0);
    SinCos angle = SinCos(nusselt_min(sqrt(dot(across, across)), 1.0), cosine);
    float power = exp_of_negative(self.exponent * negative_log_of_cosine(angle));
    return (phong_normalisation(self.exponent) * power) * self.albedo;
}

/// A Phong lobe above a Lambertian base.
BrdfComponents lambert_phong_eval_components(const Lambert lambert, const Phong phong, vec3 wi) {
    return BrdfComponents(lambert_eval(lambert, wi), phong_eval(phong, wi));
}

#endif
