#ifndef NUSSELT_SAMPLING_CYLINDER_LTC_GLSL
#define NUSSELT_SAMPLING_CYLINDER_LTC_GLSL
// Follows include/nusselt/sampling/cylinder_ltc.h @ 95e0fccacbfa
/// Sampling of a closed cylinder of finite radius in proportion to a linearly transformed cosine, without rejection.
/// With a lobe that fits the specular BRDF times cosine, the noise that remains comes from shadows and from the misfit.
/// Twin of include/nusselt/sampling/cylinder_ltc.h.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: that of the lobe times a factor that varies
/// little with the azimuth around the image of the axis. ltc_density / pdf is unbiased. Space: shading space with wo in
/// the xz half-plane (shading_frame()); clips to the horizon of cosine space by itself. Edge cases: nothing of the light
/// in the lobe, no length or radius, or origin inside: pdf = 0, measure 0. Samples may lie below the surface, wi.z < 0:
/// they count, with a contribution of zero.

#include "../core/light_sample.glsl"
#include "../sampling/cylinder_fan.glsl"

struct CylinderLtc {
    Ltc ltc;
    CylinderFan fan; ///< scaled to an extent of order one
    float inverse_scale;
};

/// \param light in shading space [m].
CylinderLtc cylinder_ltc_prepare(const Cylinder light, const Ltc ltc) {
    float scale = scale_of(light);
    return CylinderLtc(ltc, make_cylinder_fan(kNusseltCosineImportance, scaled(light, scale), ltc),
                       reciprocal_power_of_two(scale));
}

/// Estimate of the integral of the lobe over the light: good enough for weights of multiple importance sampling, not for
/// shading.
float cylinder_ltc_measure(const CylinderLtc self) { return (1.0 / kNusseltPi) * self.fan.integral; }

/// \param wi a unit direction towards the light.
float cylinder_ltc_pdf(const CylinderLtc self, vec3 wi) {
    float density = kNusseltPi * ltc_density(self.ltc, wi) * cylinder_fan_density_per_importance(self.fan, wi);
    return is_finite(density) ? density : 0.0;
}

/// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves along it. Continuous in both.
LightSample cylinder_ltc_sample(const CylinderLtc self, vec2 u) {
    vec3 p = cylinder_fan_point(self.fan, u);
    vec3 wi = self.fan.integral > 0.0 ? inverse_length(p) * p : vec3(0.0, 0.0, 1.0);
    return LightSample(wi, cylinder_ltc_pdf(self, wi), self.inverse_scale * p);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cylinder_ltc_invert(const CylinderLtc self, vec3 wi) {
    return cylinder_fan_invert(self.fan, wi, ltc_to_cosine(self.ltc, wi));
}

#endif
