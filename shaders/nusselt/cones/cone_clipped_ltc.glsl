#ifndef NUSSELT_CONES_CONE_CLIPPED_LTC_GLSL
#define NUSSELT_CONES_CONE_CLIPPED_LTC_GLSL
// Follows include/nusselt/cones/cone_clipped_ltc.h @ 45d7d6653e01
/// Sampling of the part above the surface of ellipses and ellipsoids (disks and spheres: disk_light(), sphere_light())
/// in proportion to a linearly transformed cosine. Twin of include/nusselt/cones/cone_clipped_ltc.h, which has the
/// measure and the edge cases.
///
/// Space: shading space with wo in the xz half-plane (shading_frame()); clips to both horizons. wi.z is not negative.

#include "../cones/cosine_cone.glsl"
#include "../cones/lune_sweep.glsl"
#include "../cones/round_lights.glsl"
#include "../core/light_sample.glsl"

struct ConeClippedLtc {
    Ltc ltc;
    RoundLightView view; ///< its cone is in cosine space
    bool is_clipped;     ///< whether the surface's horizon cuts the light
    CosineCone image;    ///< only where it does not
    LuneSweep lune;      ///< only where it does
    float measure;       ///< projected solid angle of the part of the image that counts [sr]
};

ConeClippedLtc cone_clipped_ltc_of(const RoundLightView view, const Ltc ltc) {
    ConeClippedLtc self;
    self.ltc = ltc;
    self.view = view;
    LuneMap map = make_lune_map(view.cone, nusselt_normalize(ltc_normal_to_cosine(ltc, vec3(0.0, 0.0, 1.0))));
    self.is_clipped = map.is_clipped;
    if (self.is_clipped) {
        // The sweep is costly to prepare, and seldom needed.
        self.lune = make_lune_sweep(map, view.cone.is_visible);
        self.measure = self.lune.measure;
    } else {
        self.image = make_cosine_cone(view.cone);
        self.measure = map.is_lit ? cosine_cone_measure(self.image) : 0.0;
    }
    return self;
}
/// \param light in shading space [m].
ConeClippedLtc cone_clipped_ltc_prepare(const Ellipse light, const Ltc ltc) {
    return cone_clipped_ltc_of(view_of(light, ltc), ltc);
}
ConeClippedLtc cone_clipped_ltc_prepare(const Ellipsoid light, const Ltc ltc) {
    return cone_clipped_ltc_of(view_of(light, ltc), ltc);
}

/// Integral of the lobe over the part of the light above the surface, in [0, 1].
float cone_clipped_ltc_measure(const ConeClippedLtc self) {
    return nusselt_min((1.0 / kNusseltPi) * self.measure, 1.0);
}

/// \param wi a unit direction towards the light.
/// \return 0 below the surface.
float cone_clipped_ltc_pdf(const ConeClippedLtc self, vec3 wi) {
    vec3 image = nusselt_normalize(ltc_to_cosine(self.ltc, wi));
    float factor = self.is_clipped ? lune_sweep_density_per_cosine(self.lune, image)
                                   : cosine_cone_density_per_cosine(self.image, image);
    float density = kNusseltPi * ltc_density(self.ltc, wi) * factor;
    return self.measure > 0.0 && wi.z >= 0.0 && is_finite(density) ? density : 0.0;
}

/// \param u in [0, 1)^2; u.x turns around an axis, u.y leads away from it or along it. Continuous in both.
LightSample cone_clipped_ltc_sample(const ConeClippedLtc self, vec2 u) {
    ConeSample s;
    if (self.is_clipped)
        s = lune_sweep_sample(self.lune, u);
    else
        s = cosine_cone_sample(self.image, u);
    vec3 direction = ltc_to_shading(self.ltc, s.wi);
    // Rounding must not lead below a horizon that the light touches.
    direction.z = nusselt_max(direction.z, 0.0);
    vec3 wi = self.measure > 0.0 ? nusselt_normalize(direction) : vec3(0.0, 0.0, 1.0);
    float distance = nusselt_max(dot(wi, round_light_point(self.view, s.disk, wi)), 0.0);
    return LightSample(wi, cone_clipped_ltc_pdf(self, wi), (self.view.inverse_scale * distance) * wi);
}

/// The random numbers for which the sample is wi, a unit direction on the light and above the surface.
vec2 cone_clipped_ltc_invert(const ConeClippedLtc self, vec3 wi) {
    vec3 image = nusselt_normalize(ltc_to_cosine(self.ltc, wi));
    if (self.is_clipped) return lune_sweep_invert(self.lune, image);
    return cosine_cone_invert(self.image, image);
}

#endif
