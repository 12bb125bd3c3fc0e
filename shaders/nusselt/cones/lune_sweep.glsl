#ifndef NUSSELT_CONES_LUNE_SWEEP_GLSL
#define NUSSELT_CONES_LUNE_SWEEP_GLSL
// Follows include/nusselt/cones/lune_sweep.h @ 42722eda0ff3
/// Sampling of the part of an elliptic cone between two horizons, in proportion to the cosine at the first one. Twin of
/// include/nusselt/cones/lune_sweep.h, where the method is described.

#include "../cones/cone_sweep.glsl"
#include "../cones/lune_map.glsl"

/// The first horizon is z = 0, the second one a plane through the y-axis. Valid where map.is_clipped; else it has any
/// density.
struct LuneSweep {
    LuneMap map;
    RimDistribution rim;
    float measure; ///< projected solid angle of the part between both horizons [sr]
    float inverse_measure;
};

/// The place z whose density has zeros at both ends in w.
float lune_sweep_stretched(float w) {
    float rest = 1.0 - w;
    return 1.0 - 0.5 * rest * rest;
}

/// The inverse of lune_sweep_stretched(). It keeps away from the end, where densities are quotients of numbers that
/// vanish.
float lune_sweep_squeezed(float z) {
    return nusselt_min(1.0 - sqrt(nusselt_max(2.0 * (1.0 - z), 0.0)), 1.0 - 4.0 * kNusseltEpsilon);
}

float lune_sweep_density(const LuneMap map, float w) {
    return (1.0 - w) * lune_turn_density(lune_map_turned(map, lune_sweep_stretched(w)));
}

LuneSweep make_lune_sweep(const LuneMap map, bool is_visible) {
    LuneSweep self;
    self.map = map;
    float value[kNusseltRimNodes];
    // Without NUSSELT_UNROLL: drivers would compile 16 copies of the density.
    NUSSELT_LOOP for (int i = 0; i < kNusseltRimNodes; ++i) value[i] = lune_sweep_density(map, kNusseltRimNode[i]);
    self.rim = make_rim_distribution(value);
    float measure = rim_distribution_integral(self.rim) * lune_map_scale(map);
    float inverse = 1.0 / (measure > 0.0 ? measure : 1.0);
    // Fractions of the measure must not be denormal: devices may flush them to zero.
    bool lit = map.is_clipped && is_visible && measure > 4.0 * kNusseltSmallestNormal && is_finite(inverse);
    self.measure = lit ? measure : 0.0;
    self.inverse_measure = lit ? inverse : 0.0;
    return self;
}

float lune_turn_measure(const LuneTurn turn) {
    return lune_turn_measure_up_to(turn, turn.angle, turn.half_sine, turn.half_cosine);
}

/// The angle from the near end below which a share of the measure of a half-plane is.
float lune_turn_angle_at(const LuneTurn turn, float share) {
    float total = lune_turn_measure(turn);
    // From the pole, the angle is that of the inverse cycloid. For half-planes that meet the cone far from the pole,
    // its digits do not suffice.
    SinCos far_end = sincos_half_turn(turn.gamma);
    float fraction = cycloid_fraction(turn.gamma, far_end.sine, far_end.cosine);
    float inverse = over_positive(1.0, turn.across);
    float lever = turn.gamma * inverse;
    float from_pole = (1.0 / 3.0) * fraction * (lever * lever * lever);
    float outer = (1.0 - share) * over_positive(total, from_pole);
    float start = inverse_cycloid(nusselt_min(nusselt_max(1.0 - outer, 0.0), 1.0), turn.gamma, fraction);
    float angle = nusselt_min(nusselt_max(start - turn.near_gamma, 0.0), turn.angle);
    SinCos half_turn = sincos_half_turn(0.5 * angle);
    float sine = sincos_half_turn(turn.near_gamma + angle).sine * inverse;
    float excess = lune_turn_measure_up_to(turn, angle, half_turn.sine, half_turn.cosine) - share * total;
    return nusselt_min(nusselt_max(angle - over_positive(excess, sine * sine * inverse), 0.0), turn.angle);
}

/// \param u in [0, 1)^2; u.x turns around the axis, u.y leads away from the pole. Continuous in both.
ConeSample lune_sweep_sample(const LuneSweep self, vec2 u) {
    LuneTurn turn = lune_map_turned(self.map, lune_sweep_stretched(rim_distribution_invert(self.rim, u.x)));
    float angle = lune_turn_angle_at(turn, u.y);
    SinCos s = sincos_half_turn(turn.near_gamma + angle);
    vec3 wi = s.cosine * lune_map_pole(self.map) + (s.sine * turn.away.x) * lune_map_h(self.map);
    wi.z = s.sine * turn.away.y;
    float near = turn.near_length * sincos_half_turn(angle).sine;
    float rest = turn.far_length * sincos_half_turn(nusselt_max(turn.angle - angle, 0.0)).sine;
    float share = nusselt_min(over_positive(near, near + rest), 1.0);
    return ConeSample(wi, turn.near_end + share * (turn.far_end - turn.near_end));
}

/// The density of a unit direction in the cone over its cosine [1/sr].
float lune_sweep_density_per_cosine(const LuneSweep self, vec3 wi) {
    if (self.rim.is_exact) return self.inverse_measure;
    float w = lune_sweep_squeezed(lune_map_place_of(self.map, wi));
    return over_positive(rim_distribution_value(self.rim, w), lune_sweep_density(self.map, w)) * self.inverse_measure;
}

/// The random numbers for which the sample is a unit direction in the cone.
vec2 lune_sweep_invert(const LuneSweep self, vec3 wi) {
    LuneTurn turn = lune_map_turned(self.map, lune_map_place_of(self.map, wi));
    float gamma = atan2_positive(hypotenuse(wi.x, wi.z), self.map.ahead * wi.y);
    float angle = nusselt_min(nusselt_max(gamma - turn.near_gamma, 0.0), turn.angle);
    SinCos half_turn = sincos_half_turn(0.5 * angle);
    float below = rim_distribution_below(self.rim, lune_sweep_squeezed(turn.z));
    float swept = lune_turn_measure_up_to(turn, angle, half_turn.sine, half_turn.cosine);
    return vec2(below_one(over_positive(below, rim_distribution_integral(self.rim))),
                below_one(over_positive(swept, lune_turn_measure(turn))));
}

#endif
