#ifndef NUSSELT_CONES_SOLID_SWEEP_GLSL
#define NUSSELT_CONES_SOLID_SWEEP_GLSL
// Follows include/nusselt/cones/solid_sweep.h @ 3c438b399975
/// Sampling of the part of an elliptic cone above a horizon that cuts it, by solid angle. Twin of
/// include/nusselt/cones/solid_sweep.h, where the method is described.

#include "../cones/cone_sweep.glsl"
#include "../cones/rim_distribution.glsl"
#include "../cones/rim_map.glsl"

/// The horizon is z = 0. Valid for cones that the horizon cuts; others give a measure of 0 or any density.
struct SolidSweep {
    RimMap map;
    RimDistribution rim;
    float measure; ///< solid angle of the part above the horizon [sr]
    float inverse_measure;
};

/// \param w in [-1, 1]
float solid_sweep_stretched(float w) { return 0.5 * w * nusselt_fma(-w, w, 3.0); }

/// The derivative of solid_sweep_stretched().
float solid_sweep_slope(float w) { return 1.5 * ((1.0 - w) * (1.0 + w)); }

/// The inverse of solid_sweep_stretched(): the root of a cubic, by a third of an angle. It keeps away from the ends,
/// where densities are quotients of numbers that vanish.
float solid_sweep_squeezed(float z) {
    float angle = atan2_positive(abs(z), sqrt(nusselt_max((1.0 - z) * (1.0 + z), 0.0)));
    float w = 2.0 * sincos_quarter_turn((1.0 / 3.0) * angle).sine;
    return copysign(nusselt_min(w, 1.0 - 4.0 * kNusseltEpsilon), z);
}

/// \param cone with a visible part above the horizon.
SolidSweep make_solid_sweep(const EllipticCone cone) {
    SolidSweep self;
    self.map = make_rim_map(cone);
    float value[kNusseltRimNodes];
    NUSSELT_LOOP for (int i = 0; i < kNusseltRimNodes; ++i) {
        float w = kNusseltRimNode[i];
        RimTurn turn = rim_map_turned(self.map, solid_sweep_stretched(w));
        value[i] = solid_sweep_slope(w) * rim_map_solid_density(self.map, turn);
    }
    self.rim = make_rim_distribution(value);
    float measure = rim_distribution_integral(self.rim) * rim_map_solid_scale(self.map);
    float inverse = 1.0 / (measure > 0.0 ? measure : 1.0);
    // Fractions of the measure must not be denormal: devices may flush them to zero.
    bool lit = self.map.is_cut && cone.is_visible && measure > 4.0 * kNusseltSmallestNormal && is_finite(inverse);
    self.measure = lit ? measure : 0.0;
    self.inverse_measure = lit ? inverse : 0.0;
    return self;
}

/// \param u in [0, 1)^2; u.x turns around the pole, u.y leads away from it. Continuous in both.
ConeSample solid_sweep_sample(const SolidSweep self, vec2 u) {
    float z = solid_sweep_stretched(rim_distribution_invert(self.rim, u.x));
    RimPoint rim = rim_map_turned(self.map, z).rim;
    float versine = u.y * rim_point_versine(rim);
    float cosine = 1.0 - versine;
    float sine = sqrt(nusselt_max(versine * (2.0 - versine), 0.0));

    // The direction in the plane of pole and rim, of which the normal keeps its height.
    vec3 away = nusselt_normalize(vec3(rim.aside, rim.up, 0.0));
    vec3 wi = cosine * self.map.p + (sine * away.x) * self.map.h;
    wi.z = sine * away.y;
    // The rim is the end of the way from the pole to it.
    float near = self.map.len * sine;
    float rest = nusselt_max(hypotenuse(rim.aside, rim.up) * cosine - rim.along * sine, 0.0);
    float share = nusselt_min(over_positive(near, rest + near), 1.0);
    return ConeSample(wi, rim_map_towards(self.map, rim, share));
}

/// The density of a unit direction in the cone [1/sr].
float solid_sweep_density(const SolidSweep self, vec3 wi) {
    if (self.rim.is_exact) return self.inverse_measure;
    RimTurn turn = rim_map_turned(self.map, rim_map_place_of(self.map, wi));
    float w = solid_sweep_squeezed(turn.z);
    float fitted = rim_distribution_value(self.rim, w);
    return over_positive(fitted, solid_sweep_slope(w) * rim_map_solid_density(self.map, turn)) * self.inverse_measure;
}

/// The random numbers for which the sample is a unit direction in the cone.
vec2 solid_sweep_invert(const SolidSweep self, vec3 wi) {
    RimTurn turn = rim_map_turned(self.map, rim_map_place_of(self.map, wi));
    float across = hypotenuse(dot(wi, self.map.h), wi.z);
    float along = dot(wi, self.map.p);
    float below = rim_distribution_below(self.rim, solid_sweep_squeezed(turn.z));
    return vec2(below_one(over_positive(below, rim_distribution_integral(self.rim))),
                below_one(over_positive(versine_of(across, along), rim_point_versine(turn.rim))));
}

#endif
