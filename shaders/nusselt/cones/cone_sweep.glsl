#ifndef NUSSELT_CONES_CONE_SWEEP_GLSL
#define NUSSELT_CONES_CONE_SWEEP_GLSL
// Follows include/nusselt/cones/cone_sweep.h @ c3490b49274e
/// Sampling of the part of an elliptic cone above a horizon that cuts it, in proportion to the cosine at the surface.
/// Twin of include/nusselt/cones/cone_sweep.h, where the method is described.

#include "../cones/rim_distribution.glsl"
#include "../cones/rim_map.glsl"

/// A direction in an elliptic cone.
struct ConeSample {
    vec3 wi;   ///< unit
    vec2 disk; ///< the point of the disk of the cone
};

/// The horizon is z = 0. Valid for cones that the horizon cuts; others give a measure of 0 or any density.
struct ConeSweep {
    RimMap map;
    RimDistribution rim;
    float measure; ///< projected solid angle of the part above the horizon [sr]
    float inverse_measure;
};

/// \param cone with a visible part above the horizon.
ConeSweep make_cone_sweep(const EllipticCone cone) {
    ConeSweep self;
    self.map = make_rim_map(cone);
    float value[kNusseltRimNodes];
    NUSSELT_LOOP for (int i = 0; i < kNusseltRimNodes; ++i)
        value[i] = rim_map_density(self.map, rim_map_turned(self.map, kNusseltRimNode[i]));
    self.rim = make_rim_distribution(value);
    float measure = rim_distribution_integral(self.rim) * rim_map_scale(self.map);
    float inverse = 1.0 / (measure > 0.0 ? measure : 1.0);
    // Fractions of the measure must not be denormal: devices may flush them to zero.
    bool lit = self.map.is_cut && cone.is_visible && measure > 4.0 * kNusseltSmallestNormal && is_finite(inverse);
    self.measure = lit ? measure : 0.0;
    self.inverse_measure = lit ? inverse : 0.0;
    return self;
}

/// \param u in [0, 1)^2; u.x turns around the pole, u.y leads away from it.
ConeSample cone_sweep_sample(const ConeSweep self, vec2 u) {
    RimPoint rim = rim_map_turned(self.map, rim_distribution_invert(self.rim, u.x)).rim;
    float gamma = inverse_cycloid(u.y, rim.angle, cycloid_fraction(rim.angle, rim.sine, rim.cosine));
    SinCos s = sincos_half_turn(gamma);
    SinCos rest = sincos_half_turn(nusselt_max(rim.angle - gamma, 0.0));

    // The direction in the plane of pole and rim, of which the normal keeps its height.
    vec3 away = nusselt_normalize(vec3(rim.aside, rim.up, 0.0));
    vec3 wi = s.cosine * self.map.p + (s.sine * away.x) * self.map.h;
    wi.z = s.sine * away.y;
    // The rim is the end of the way from the pole to it.
    float near = self.map.len * s.sine;
    float share = nusselt_min(over_positive(near, nusselt_fma(rim.len, rest.sine, near)), 1.0);
    return ConeSample(wi, rim_map_towards(self.map, rim, share));
}

/// The density of a unit direction in the cone over its cosine [1/sr].
float cone_sweep_density_per_cosine(const ConeSweep self, vec3 wi) {
    if (self.rim.is_exact) return self.inverse_measure;
    RimTurn turn = rim_map_turned(self.map, rim_map_place_of(self.map, wi));
    return over_positive(rim_distribution_value(self.rim, turn.z), rim_map_density(self.map, turn)) *
           self.inverse_measure;
}

/// The random numbers for which the sample is a unit direction in the cone.
vec2 cone_sweep_invert(const ConeSweep self, vec3 wi) {
    RimTurn turn = rim_map_turned(self.map, rim_map_place_of(self.map, wi));
    float across = hypotenuse(dot(wi, self.map.h), wi.z);
    float along = dot(wi, self.map.p);
    float gamma = nusselt_min(atan2_positive(across, along), turn.rim.angle);
    float share = over_positive(gamma, turn.rim.angle);
    float inner = cycloid_fraction(gamma, across, along);
    float outer = cycloid_fraction(turn.rim.angle, turn.rim.sine, turn.rim.cosine);
    float below = over_positive(rim_distribution_below(self.rim, turn.z), rim_distribution_integral(self.rim));
    return vec2(below_one(below), below_one(share * share * share * (inner / outer)));
}

#endif
