#ifndef NUSSELT_CONES_CONE_LTC_GLSL
#define NUSSELT_CONES_CONE_LTC_GLSL
// Follows include/nusselt/cones/cone_ltc.h @ c3ebf9dea848
/// Sampling of ellipses and ellipsoids (disks and spheres: disk_light(), sphere_light()) in proportion to a linearly
/// transformed cosine. Twin of include/nusselt/cones/cone_ltc.h, which has the measure and the edge cases.
///
/// Space: shading space with wo in the xz half-plane (shading_frame()); clips to the horizon of cosine space by itself.
/// Samples may lie below the surface, wi.z < 0: they count, with a contribution of zero.

#include "../cones/cosine_cone.glsl"
#include "../cones/round_lights.glsl"
#include "../core/light_sample.glsl"

struct ConeLtc {
    Ltc ltc;
    RoundLightView view; ///< its cone is in cosine space
    CosineCone image;
};

ConeLtc cone_ltc_of(const RoundLightView view, const Ltc ltc) {
    return ConeLtc(ltc, view, make_cosine_cone(view.cone));
}
/// \param light in shading space [m].
ConeLtc cone_ltc_prepare(const Ellipse light, const Ltc ltc) { return cone_ltc_of(view_of(light, ltc), ltc); }
ConeLtc cone_ltc_prepare(const Ellipsoid light, const Ltc ltc) { return cone_ltc_of(view_of(light, ltc), ltc); }

/// Integral of the lobe over the light, in [0, 1].
float cone_ltc_measure(const ConeLtc self) {
    return nusselt_min((1.0 / kNusseltPi) * cosine_cone_measure(self.image), 1.0);
}

/// \param wi a unit direction towards the light.
float cone_ltc_pdf(const ConeLtc self, vec3 wi) {
    float factor = cosine_cone_density_per_cosine(self.image, nusselt_normalize(ltc_to_cosine(self.ltc, wi)));
    float density = kNusseltPi * ltc_density(self.ltc, wi) * factor;
    return is_finite(density) ? density : 0.0;
}

/// \param u in [0, 1)^2; as continuous as that of ConeProjectedSolidAngle.
LightSample cone_ltc_sample(const ConeLtc self, vec2 u) {
    ConeSample s = cosine_cone_sample(self.image, u);
    bool dark = !(cosine_cone_measure(self.image) > 0.0);
    vec3 wi = dark ? vec3(0.0, 0.0, 1.0) : nusselt_normalize(ltc_to_shading(self.ltc, s.wi));
    float distance = nusselt_max(dot(wi, round_light_point(self.view, s.disk, wi)), 0.0);
    return LightSample(wi, cone_ltc_pdf(self, wi), (self.view.inverse_scale * distance) * wi);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cone_ltc_invert(const ConeLtc self, vec3 wi) {
    return cosine_cone_invert(self.image, nusselt_normalize(ltc_to_cosine(self.ltc, wi)));
}

#endif
