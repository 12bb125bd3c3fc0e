#ifndef NUSSELT_CONES_LUNE_MAP_GLSL
#define NUSSELT_CONES_LUNE_MAP_GLSL
// Follows include/nusselt/cones/lune_map.h @ 2d602e42332a
/// The rim of an elliptic cone between two horizons, as a function of z in [-1, 1] for which the measure of a sweep is
/// smooth. Twin of include/nusselt/cones/lune_map.h.

#include "../cones/cycloid.glsl"
#include "../cones/elliptic_cone.glsl"
#include "../cones/horizon_gaps.glsl"
#include "../cones/rim_angles.glsl"
#include "../core/trig.glsl"

/// The first horizon is z = 0, the second one a plane through the y-axis. Half-planes through the y-axis turn from the
/// first one to the second one around the pole, that of the two directions of the axis that is closer to the axis of
/// the cone.
struct LuneMap {
    vec3 lengths;            ///< a, b, c of the cone
    float ahead, side;       ///< signs of the pole along y and of h along x
    float turn_sign;         ///< of angles in the disk as half-planes turn up from the first horizon
    float pole_scale;        ///< by which the next two are divided
    float away, level;       ///< the pole as a homogeneous point of the disk: distance from the centre, weight
    bool is_inside;          ///< whether the pole is in the cone
    vec2 farthest;           ///< the point of the rim opposite to the pole
    vec2 inner;              ///< the pole in the disk
    float tangent_cosine;    ///< of the angle between the pole and the points at which half-planes touch the rim
    vec3 basis_h, basis_p, basis_n; ///< h, pole and normal in the basis of the cone
    bool is_clipped;         ///< whether the second horizon cuts the part of the cone above the first one
    bool is_lit;             ///< whether anything of the cone is above both horizons
    RimAngles angles;        ///< from the farthest point
    bool starts_at_horizon;  ///< else where the first half-plane touches the rim
    vec2 start;
    vec2 level_turn;         ///< sine and cosine of half of the arc that the first horizon, or the pole's polar line, cuts off
    float horizon;           ///< height above the first horizon per height in the disk
    float begin, half_range; ///< angles of the map
    vec2 start_half;         ///< sine and cosine of half of begin
    float start_scale, start_squeezed;
};

/// A half-plane and what it has of the cone: the way from the near end, on the rim or at the pole, to the far end on
/// the rim.
struct LuneTurn {
    float z;
    vec2 far_end, near_end;        ///< in the disk of the cone
    float far_length, near_length; ///< of their directions, which are not of unit length
    vec2 away;                     ///< the half-plane's direction along h and the normal, of unit length
    float gamma, near_gamma;       ///< angles of both ends from the pole
    float angle;                   ///< between both ends
    float half_sine, half_cosine;  ///< of half of it
    float clearance;               ///< height of the far end's direction above the first horizon
    float across;                  ///< distance of the far end's direction from the axis of the pole
    float volume;                  ///< of pole, far end and its derivative, up to a constant
    float jacobian;                ///< angle in the disk per angle of the map
};

/// Where a plane through the pole cuts the rim.
struct LuneChord {
    bool is_cut;     ///< by the plane, which does more than touch it up to rounding
    bool is_met;     ///< by the half-plane
    vec2 end;        ///< the end that is farther from the pole
    float height;    ///< of the axis above the plane in the disk
    float half_size; ///< of the length of the chord
    float steepness; ///< height of a direction per height in the disk
};

vec3 lune_map_pole(const LuneMap self) { return vec3(0.0, self.ahead, 0.0); }

/// Unit: horizontal, perpendicular to the pole, and above the second horizon.
vec3 lune_map_h(const LuneMap self) { return vec3(self.side, 0.0, 0.0); }

/// The direction of a point of the disk, not of unit length, along an axis that is given in the basis of the cone.
float lune_map_component(const LuneMap self, vec2 disk, vec3 axis) {
    vec3 scaled = self.lengths * axis;
    return nusselt_fma(scaled.x, disk.x, nusselt_fma(scaled.y, disk.y, scaled.z));
}

float lune_map_length(const LuneMap self, vec2 disk) {
    vec2 s = self.lengths.xy * disk;
    return sqrt(nusselt_fma(s.x, s.x, nusselt_fma(s.y, s.y, self.lengths.z * self.lengths.z)));
}

/// A vector of the disk from its coordinates along and across the direction to the farthest point.
vec2 lune_map_from_farthest(const LuneMap self, vec2 v) {
    vec2 f = self.farthest;
    return vec2(f.x * v.x - f.y * v.y, f.y * v.x + f.x * v.y);
}

/// Half of the angle of the map of a point of the rim: sine and cosine times any length.
vec2 lune_map_half_angle(const LuneMap self, vec2 rim) {
    return rim_angles_half_of(self.angles, rim, self.farthest.x * rim.y - self.farthest.y * rim.x);
}

/// \param normal of the plane, in the basis of the cone.
/// \param out_of in the half-plane and perpendicular to the pole, in the basis of the cone.
LuneChord lune_map_chord(const LuneMap self, vec3 normal, vec3 out_of) {
    LuneChord chord;
    vec3 n = self.lengths * normal;
    float k = hypotenuse(n.x, n.y);
    bool crosses = abs(n.z) < k;
    // A plane that misses the rim has the point of it that is closest to the plane.
    bool leans = k > kNusseltTiny;
    chord.steepness = leans ? k : 1.0;
    float inverse = 1.0 / chord.steepness;
    vec2 up = leans ? inverse * n.xy : vec2(1.0, 0.0);
    chord.height = nusselt_min(nusselt_max(n.z * inverse, -1.0), 1.0);
    float smaller, larger;
    horizon_gaps(self.lengths, normal, chord.steepness, smaller, larger);
    // Where a plane touches the rim at the pole, rounding would choose the side of the pole on which its end is.
    chord.is_cut = crosses && smaller > 0.25 * kNusseltEpsilon;
    chord.half_size = sqrt(nusselt_max(smaller * larger, 0.0));
    vec2 middle = -chord.height * up;
    vec2 along = chord.half_size * vec2(-up.y, up.x);
    vec2 left = middle + along;
    vec2 right = middle - along;
    float to_left = self.is_inside ? lune_map_component(self, left, out_of) : dot(left, self.farthest);
    float to_right = self.is_inside ? lune_map_component(self, right, out_of) : dot(right, self.farthest);
    chord.end = to_left >= to_right ? left : right;
    chord.is_met = chord.is_cut && (self.is_inside || lune_map_component(self, chord.end, out_of) > 0.0);
    return chord;
}

/// Unless the cone is clipped, only is_clipped and is_lit are valid.
/// \param normal of the second horizon, (x, 0, z), of unit length.
LuneMap make_lune_map(const EllipticCone cone, vec3 normal) {
    LuneMap self;
    float a = cone.a;
    float b = cone.b;
    // Half-spaces count as cones with large angles, for which points of the rim have digits left.
    float c = nusselt_max(cone.c, kNusseltConeRounding);
    self.lengths = vec3(a, b, c);
    bool wide = nusselt_min(a, b) > kNusseltTiny;

    // The pole, as a homogeneous point of the disk.
    self.ahead = cone.e3.y < 0.0 ? -1.0 : 1.0;
    self.side = normal.x < 0.0 ? -1.0 : 1.0;
    self.turn_sign = -self.side * self.ahead;
    vec2 pole = self.ahead * vec2((b * c) * cone.e1.y, (a * c) * cone.e2.y);
    float weight = self.ahead * (a * b) * cone.e3.y;
    float away = hypotenuse(pole.x, pole.y);
    self.pole_scale = nusselt_max(away, weight);
    float inverse = over_positive(1.0, self.pole_scale);
    self.away = away * inverse;
    self.level = weight * inverse;
    // A pole within rounding of the rim counts as one on the rim: there, half-planes on the far side have no end of
    // their own.
    self.is_inside = weight > (1.0 + 256.0 * kNusseltEpsilon) * away;
    bool aside = away > kNusseltTiny * self.pole_scale;
    self.farthest = aside ? -(1.0 / away) * pole : vec2(1.0, 0.0);
    self.tangent_cosine = self.is_inside ? 0.0 : nusselt_min(self.level / self.away, 1.0);
    self.inner = self.is_inside ? (1.0 / weight) * pole : pole;

    self.basis_h = self.side * vec3(cone.e1.x, cone.e2.x, cone.e3.x);
    self.basis_p = self.ahead * vec3(cone.e1.y, cone.e2.y, cone.e3.y);
    self.basis_n = vec3(cone.e1.z, cone.e2.z, cone.e3.z);

    // Where both horizons cut the cone.
    float lateral = abs(normal.x);
    vec3 second = difference_of_products(vec3(lateral), self.basis_h, vec3(-normal.z), self.basis_n);
    vec3 out_of = difference_of_products(vec3(lateral), self.basis_n, vec3(normal.z), self.basis_h);
    LuneChord first_cut = lune_map_chord(self, self.basis_n, self.basis_h);
    LuneChord second_cut = lune_map_chord(self, second, out_of);
    bool has_second = lateral > 4.0 * kNusseltEpsilon;
    self.is_clipped = wide && has_second && second_cut.is_met;
    // A cone that only touches the second horizon is on the side of its axis.
    bool above_first = first_cut.is_met || (!first_cut.is_cut && self.basis_n.z > 0.0);
    bool above_second = second_cut.is_cut || second.z > 0.0;
    self.is_lit = self.is_clipped || (has_second ? above_first && above_second : normal.z > 0.0);

    // The map is costly to prepare, and seldom needed.
    if (!self.is_clipped) return self;

    // Choose the map of the rim.
    self.angles = make_rim_angles(self.lengths, self.farthest);
    float len = lune_map_length(self, self.farthest);
    float along = lune_map_component(self, self.farthest, self.basis_p) / len;
    float across = hypotenuse(lune_map_component(self, self.farthest, self.basis_h),
                              lune_map_component(self, self.farthest, self.basis_n)) /
                   len;
    rim_angles_set_stretch(self.angles, nusselt_max(0.5 * versine_of(across, -along), kNusseltTiny));

    // The rim from the first horizon, or where the first half-plane touches it, to the second horizon.
    self.starts_at_horizon = first_cut.is_met;
    float t = self.tangent_cosine;
    float tangent_sine = sqrt(nusselt_max((1.0 - t) * (1.0 + t), 0.0));
    self.start = self.starts_at_horizon ? first_cut.end
                                        : lune_map_from_farthest(self, vec2(-t, -self.turn_sign * tangent_sine));
    self.level_turn = self.starts_at_horizon ? vec2(first_cut.half_size, -first_cut.height) : vec2(tangent_sine, -t);
    self.horizon = first_cut.steepness;
    vec2 half_turn = lune_map_half_angle(self, self.start);
    // A pole on the rim is where half-planes touch, at half a turn from the farthest point: on the side of the start.
    half_turn.x = copysign(half_turn.x, self.starts_at_horizon ? half_turn.x : -self.turn_sign);
    self.begin = rim_angle_of(half_turn);
    self.start_half = (1.0 / hypotenuse(half_turn.x, half_turn.y)) * half_turn;
    self.start_scale = hypotenuse(self.angles.stretch * self.start_half.y, self.start_half.x);
    // The length of diag(squeeze, 1) times the unit vector that leads to the start.
    self.start_squeezed = self.angles.squeeze / hypotenuse(self.start.x, self.angles.squeeze * self.start.y);
    float range = self.turn_sign * (rim_angle_of(lune_map_half_angle(self, second_cut.end)) - self.begin);
    if (self.is_inside && range < 0.0) range += 2.0 * kNusseltPi;
    self.half_range = 0.5 * nusselt_max(range, 0.0);
    return self;
}

/// The measure of the sweep over the integral of lune_turn_density() over z.
float lune_map_scale(const LuneMap self) { return self.pole_scale * self.half_range; }

/// What a half-plane has of the cone, from its far end.
/// \param far_cosine of the angle between the far end and the farthest point.
void lune_map_add_chord(const LuneMap self, inout LuneTurn turn, float far_cosine) {
    vec3 l = self.lengths;
    vec2 rim = turn.far_end;
    // The other point of the rim on the line to the pole, or the pole if it is within.
    float far_sine = self.farthest.x * rim.y - self.farthest.y * rim.x;
    float t = self.tangent_cosine;
    float sum = nusselt_fma(2.0 * t, far_cosine, nusselt_fma(t, t, 1.0));
    float factor = 2.0 * over_positive(turn.volume, self.away) / nusselt_max(sum, kNusseltTiny);
    vec2 chord = rim - self.inner;
    if (!self.is_inside)
        chord = lune_map_from_farthest(self, factor * vec2(nusselt_fma(t, far_cosine, 1.0), t * far_sine));
    // The difference would lose the digits of a pole in the middle of a wide cone.
    vec2 near_end = self.is_inside ? self.inner : rim - chord;
    turn.near_end = near_end;
    turn.far_length = lune_map_length(self, rim);
    turn.near_length = lune_map_length(self, near_end);

    // The angle between both ends: no term of the cross product cancels.
    vec3 normal = vec3((l.y * l.z) * chord.y, (l.x * l.z) * chord.x, (l.x * l.y) * (rim.x * chord.y - rim.y * chord.x));
    float scalar = (l.x * rim.x) * (l.x * near_end.x) + (l.y * rim.y) * (l.y * near_end.y) + l.z * l.z;
    turn.angle = atan2_positive(nusselt_length(normal), scalar);
    SinCos half_turn = sincos_half_turn(0.5 * turn.angle);
    turn.half_sine = half_turn.sine;
    turn.half_cosine = half_turn.cosine;

    float aside = lune_map_component(self, rim, self.basis_h);
    turn.across = hypotenuse(aside, turn.clearance);
    turn.away = turn.across > 0.0 ? vec2(aside, turn.clearance) / turn.across : vec2(1.0, 0.0);
    turn.gamma = atan2_positive(turn.across, lune_map_component(self, rim, self.basis_p));
    turn.near_gamma = self.is_inside ? 0.0 : nusselt_max(turn.gamma - turn.angle, 0.0);
}

/// \param z in [-1, 1]
LuneTurn lune_map_turned(const LuneMap self, float z) {
    LuneTurn turn;
    turn.z = z;
    SinCos way = sincos_half_turn(self.half_range * (0.5 * (z + 1.0)));
    float signed_sine = self.turn_sign * way.sine;
    float x = self.angles.stretch * (self.start_half.y * way.cosine - self.start_half.x * signed_sine);
    float s = self.start_half.x * way.cosine + self.start_half.y * signed_sine;
    RimAnglesPoint point = rim_angles_at(self.angles, x, s);
    vec2 rim = point.inverse_length * point.scaled;
    turn.far_end = rim;
    turn.jacobian = point.jacobian;

    // The angle in the disk from the start, accurate relative to itself.
    float per_scale = sqrt(point.inverse_norm) / self.start_scale;
    float half_sine = self.angles.stretch * way.sine * per_scale;
    float half_cosine = (x * (self.angles.stretch * self.start_half.y) + s * self.start_half.x) * per_scale;
    float from_sine =
        self.angles.squeeze * 2.0 * half_sine * half_cosine * point.inverse_length / self.start_squeezed;
    float from_cosine = dot(rim, self.start);
    float root = sqrt(nusselt_max(0.5 * (1.0 + abs(from_cosine)), 0.5));
    float other = 0.5 * from_sine / root;
    float from_half_sine = from_cosine < 0.0 ? root : abs(other);
    float from_half_cosine = from_cosine < 0.0 ? other : copysign(root, other);
    float gain = 2.0 * from_half_sine *
                 nusselt_max(self.level_turn.x * from_half_cosine - self.level_turn.y * from_half_sine, 0.0);

    // Heights above the horizon and above the tangent from the pole: one of them vanishes at the start.
    float far_cosine = dot(rim, self.farthest);
    float height = self.starts_at_horizon ? self.horizon * gain : lune_map_component(self, rim, self.basis_n);
    turn.clearance = nusselt_max(height, 0.0);
    bool is_apart = self.starts_at_horizon || self.is_inside;
    turn.volume = nusselt_max(is_apart ? nusselt_fma(self.away, far_cosine, self.level) : self.away * gain, 0.0);
    lune_map_add_chord(self, turn, far_cosine);
    return turn;
}

/// The integral of the squared sine of the angle from the pole, over the cube of the distance of the far end from the
/// axis.
/// \param angle from the near end; sine and cosine are those of its half.
float lune_turn_measure_up_to(const LuneTurn turn, float angle, float half_sine, float half_cosine) {
    float inverse = over_positive(1.0, turn.across);
    float share = angle * inverse;
    float cube = cycloid_fraction(0.5 * angle, half_sine, half_cosine) * (share * share * share);
    float lever = sincos_half_turn(turn.near_gamma + 0.5 * angle).sine * inverse;
    return nusselt_fma(1.0 / 12.0, cube, 2.0 * half_sine * half_cosine * inverse * (lever * lever));
}

/// The measure of the sweep per z, up to a constant.
float lune_turn_density(const LuneTurn turn) {
    float swept = lune_turn_measure_up_to(turn, turn.angle, turn.half_sine, turn.half_cosine);
    return turn.clearance * turn.volume * turn.jacobian * swept;
}

/// The place z in [-1, 1] at which the half-plane of a direction meets the rim.
float lune_map_place_of(const LuneMap self, vec3 wi) {
    vec2 away = vec2(self.side * wi.x, nusselt_max(wi.z, 0.0));
    float norm = hypotenuse(away.x, away.y);
    away = norm > 0.0 ? away * (1.0 / norm) : vec2(1.0, 0.0);
    vec3 normal = away.x * self.basis_n - away.y * self.basis_h;
    vec2 end = lune_map_chord(self, normal, away.x * self.basis_h + away.y * self.basis_n).end;
    float t = self.turn_sign * (rim_angle_of(lune_map_half_angle(self, end)) - self.begin);
    float wrapped = t + 2.0 * kNusseltPi;
    if (self.is_inside && t < 0.0 && wrapped - 2.0 * self.half_range < -t) t = wrapped;
    return nusselt_min(nusselt_max(over_positive(t, self.half_range) - 1.0, -1.0), 1.0);
}

#endif
