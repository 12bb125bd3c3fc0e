#ifndef NUSSELT_CONES_RIM_MAP_GLSL
#define NUSSELT_CONES_RIM_MAP_GLSL
// Follows include/nusselt/cones/rim_map.h @ d71281903dc6
/// The rim of an elliptic cone that a horizon cuts, as a function of z in [-1, 1] for which the measure of a sweep is
/// smooth. Twin of include/nusselt/cones/rim_map.h.

#include "../cones/cycloid.glsl"
#include "../cones/elliptic_cone.glsl"
#include "../cones/horizon_gaps.glsl"
#include "../cones/rim_angles.glsl"

/// The horizon is z = 0. Cones that it does not cut have is_cut false and any numbers.
struct RimMap {
    float a, b, c;
    vec2 up;               ///< in the disk, away from the horizon
    float height;          ///< of the axis above the horizon in the disk
    float gap;             ///< 1 minus its magnitude, accurate relative to itself
    float squared_tangent; ///< of a quarter of the angle of the arc above the horizon
    float pole;            ///< across
    float power;           ///< of the pole: 1 minus its squared distance from the axis
    float len;             ///< of the pole, as a point of the cone
    vec3 p, h;             ///< unit and horizontal: to the pole, and perpendicular to it
    float shear, narrowing, slope, along_across, along_up; ///< from the disk to p, h and n
    vec2 reference;         ///< of angles: the highest point, or the one opposite to the pole; across and up
    /// The members of RimAngles, from the reference: WebGL allows four levels of structures, and techniques have as many.
    float squeeze, stretch;
    vec2 mid;
    float mid_length;
    float left, half_range; ///< angles of the map
    bool is_cut;
};

/// A point of the rim.
struct RimPoint {
    vec2 disk;                    ///< across and up from the axis
    float len, along, aside, up;  ///< of its direction, which is not of unit length, and in the basis p, h, n
    float angle, sine, cosine;    ///< from the pole
};

/// A point of the rim as a function of z in [-1, 1].
struct RimTurn {
    float z;
    RimPoint rim;
    float clearance; ///< height above the horizon in the disk
    float jacobian;  ///< angle in the disk per angle of the map
};

/// \param disk      a point of the unit circle, across and up from the axis.
/// \param clearance its height above the horizon.
RimPoint rim_map_point(const RimMap self, vec2 disk, float clearance) {
    float s = self.a * (disk.y * self.up.x - disk.x * self.up.y);
    float t = self.b * (disk.y * self.up.y + disk.x * self.up.x);
    float offset = disk.x - self.pole;
    RimPoint rim;
    rim.disk = disk;
    rim.len = sqrt(nusselt_fma(s, s, nusselt_fma(t, t, self.c * self.c)));
    rim.along = nusselt_fma(self.along_across, offset, nusselt_fma(self.along_up, clearance, self.len));
    rim.aside = nusselt_fma(self.narrowing, offset, self.shear * clearance);
    rim.up = self.slope * clearance;
    float inverse = 1.0 / rim.len;
    rim.sine = hypotenuse(rim.aside, rim.up) * inverse;
    rim.cosine = rim.along * inverse;
    rim.angle = atan2_positive(rim.sine, rim.cosine);
    return rim;
}

/// The point of the disk, in the basis of the axes, at a place across and up.
vec2 rim_map_from_up(const RimMap self, vec2 disk) {
    return vec2(disk.y * self.up.x - disk.x * self.up.y, disk.y * self.up.y + disk.x * self.up.x);
}

RimAngles rim_map_angles(const RimMap self) {
    return RimAngles(self.squeeze, self.stretch, self.mid, self.mid_length);
}

/// The angle of the map of a point of the rim, given across and up from the axis.
float rim_map_angle(const RimMap self, vec2 point) {
    float across = nusselt_fma(point.x, self.reference.y, -point.y * self.reference.x);
    return rim_angle_of(rim_angles_half_of(rim_map_angles(self), rim_map_from_up(self, point), across));
}

RimMap make_rim_map(const EllipticCone cone) {
    RimMap self;
    self.a = cone.a;
    self.b = cone.b;

    // Find the horizon in the disk, n_1 a s + n_2 b t + n_3 c = 0, as the height along e_n, which leads up.
    vec3 height = heights_of_axes(cone);
    float na = height.x * self.a;
    float nb = height.y * self.b;
    float k = hypotenuse(na, nb);
    bool rises = k >= kNusseltSmallestNormal && nusselt_min(self.a, self.b) > kNusseltTiny;
    float inverse = 1.0 / (rises ? k : 1.0);
    self.up = rises ? vec2(na, nb) * inverse : vec2(1.0, 0.0);
    // Half-spaces count as cones with large angles, so that heights of points of the rim have digits left. If the rim
    // is all but a line, points at both of its ends have digits left, too. The bound is less than any height that
    // counts, whatever rounding does: each half-space is above the horizon, cut by it or below it.
    const float kRounding = 0.999 * kNusseltConeRounding;
    float extent_up = hypotenuse(self.a * self.up.x, self.b * self.up.y);
    float least = nusselt_max(kRounding * extent_up, kRounding - nusselt_min(self.a, self.b));
    self.c = nusselt_max(cone.c, least);
    float nc = height.z * self.c;
    self.is_cut = rises && abs(nc) < k;
    self.slope = self.is_cut ? k : 1.0;
    float inverse_k = self.is_cut ? inverse : 1.0;
    float larger;
    horizon_gaps(vec3(self.a, self.b, self.c), height, self.slope, self.gap, larger);
    float lower = nc < 0.0 ? larger : self.gap; // 1 - h0
    float upper = nc < 0.0 ? self.gap : larger; // 1 + h0
    self.height = nc * inverse_k;
    float half_arc = sqrt(nusselt_max(lower * upper, 0.0));
    self.squared_tangent = upper / nusselt_max(lower, kNusseltEpsilon / 16.0);

    // Find the pole, where the bisector of both ends of the horizon's arc meets it.
    vec3 across = vec3(-self.a * self.up.y, self.b * self.up.x, 0.0);
    vec3 upwards = vec3(self.a * self.up.x, self.b * self.up.y, 0.0);
    vec3 middle = vec3(-self.height * upwards.x, -self.height * upwards.y, self.c);
    float to_ends = nusselt_length(middle + half_arc * across) + nusselt_length(middle - half_arc * across);
    float relative = half_arc / (to_ends > 0.0 ? to_ends : 1.0);
    float skew = (4.0 * relative * relative) * (((self.a - self.b) * (self.a + self.b)) * (self.up.x * self.up.y));
    self.pole = -skew * self.height;
    self.power = nusselt_max((half_arc - self.pole) * (half_arc + self.pole), 0.0);
    vec3 q = middle + self.pole * across;
    self.len = nusselt_length(q);
    float inverse_distance = over_positive(1.0, self.len);
    vec3 p = inverse_distance * q;

    // Express directions of the disk in the basis of the horizontal h and the normal.
    vec3 in_world = p.x * cone.e1 + p.y * cone.e2 + p.z * cone.e3;
    self.p = nusselt_normalize(vec3(in_world.xy, 0.0));
    vec3 aside = vec3(-self.p.y, self.p.x, 0.0);
    vec3 h = vec3(dot(aside, cone.e1), dot(aside, cone.e2), dot(aside, cone.e3));
    float side = dot(h, across) < 0.0 ? -1.0 : 1.0;
    self.h = side * aside;
    self.shear = side * dot(h, upwards);
    self.narrowing = (self.c * inverse_distance) * (self.a * self.b * inverse_k);
    self.along_across = dot(p, across);
    self.along_up = dot(p, upwards);

    // Choose the map of the rim.
    // The ray to the point opposite to the pole is the one that almost reaches the antipode, if any does. Of small parts
    // above the horizon, the highest point is as good, and heights above the horizon have all their digits.
    float lean = self.height > 0.0 ? skew : 0.0;
    self.reference = vec2(lean, 1.0) * (1.0 / sqrt(nusselt_fma(lean, lean, 1.0)));
    RimAngles angles = make_rim_angles(vec3(self.a, self.b, self.c), rim_map_from_up(self, self.reference));
    RimPoint top = rim_map_point(self, self.reference, self.height > 0.0 ? self.reference.y + self.height : upper);
    rim_angles_set_stretch(angles, nusselt_max(0.5 * versine_of(top.sine, -top.cosine), kNusseltTiny));
    self.squeeze = angles.squeeze;
    self.stretch = angles.stretch;
    self.mid = angles.mid;
    self.mid_length = angles.mid_length;
    // Of a rim that is all but above the horizon, both ends are at half a turn, on either side.
    self.left = -abs(rim_map_angle(self, vec2(-half_arc, -self.height)));
    float right = abs(rim_map_angle(self, vec2(half_arc, -self.height)));
    self.half_range = 0.5 * (right - self.left);
    return self;
}

/// The measure of the sweep over the integral of rim_map_density() over z.
float rim_map_scale(const RimMap self) { return self.narrowing * self.slope * self.slope * self.half_range; }

/// The point of the disk of the cone on the way from the pole to a point of the rim.
vec2 rim_map_towards(const RimMap self, const RimPoint rim, float share) {
    vec2 from = vec2(self.pole, -self.height);
    return rim_map_from_up(self, from + share * (rim.disk - from));
}

/// \param z in [-1, 1]
RimTurn rim_map_turned(const RimMap self, float z) {
    float half_zeta = 0.5 * nusselt_fma(self.half_range, z + 1.0, self.left);
    SinCos turn = sincos_half_turn(abs(half_zeta));
    RimAnglesPoint point = rim_angles_at(rim_map_angles(self), self.stretch * nusselt_max(turn.cosine, 0.0),
                                         copysign(abs(turn.sine), half_zeta));
    float cosine = point.inverse_length * dot(point.scaled, rim_map_from_up(self, self.reference));
    float across = nusselt_fma(point.across, self.reference.y, cosine * self.reference.x);
    float up = nusselt_fma(cosine, self.reference.y, -point.across * self.reference.x);

    // The height above the horizon, by the squares of the tangents of half-angles: nothing cancels but at the ends.
    float t = up < 0.0 ? (1.0 - up) / nusselt_max(abs(across), kNusseltEpsilon) : across / (1.0 + up);
    float s = nusselt_min(t * t, self.squared_tangent);

    RimTurn result;
    result.z = z;
    result.clearance = 2.0 * (self.squared_tangent - s) / ((1.0 + s) * (1.0 + self.squared_tangent));
    result.rim = rim_map_point(self, vec2(across, up), result.clearance);
    result.jacobian = point.jacobian;
    return result;
}

/// The measure of the sweep per z, up to a constant.
float rim_map_density(const RimMap self, const RimTurn turn) {
    RimPoint rim = turn.rim;
    float weight = 0.25 * cycloid_over_cubed_sine(rim.angle, rim.sine, rim.cosine);
    // 1 + height y - pole x, where the first two terms may cancel.
    float rise = abs(rim.disk.y);
    float across = (rim.disk.x / (1.0 + rise) - self.pole) * rim.disk.x;
    float apart = nusselt_fma(-self.pole, rim.disk.x, nusselt_fma(self.height, rim.disk.y, 1.0));
    float close = nusselt_fma(self.gap, rise, across);
    float volume = nusselt_max(self.height * rim.disk.y < 0.0 ? close : apart, 0.0);
    float inverse = 1.0 / rim.len;
    return weight * turn.clearance * volume * (inverse * inverse * inverse) * turn.jacobian;
}

/// The solid angle of the sweep per z, up to a constant. It is positive at both ends as well.
float rim_map_solid_density(const RimMap self, const RimTurn turn) {
    RimPoint rim = turn.rim;
    // 1 + h0 y - pole x as a sum of squares: nothing cancels for the last sliver above the horizon.
    float offset = rim.disk.x - self.pole;
    float volume = 0.5 * nusselt_fma(offset, offset, nusselt_fma(turn.clearance, turn.clearance, self.power));
    // The length of the ray plus its part along the pole, from the square of its sine where they cancel.
    float sum = rim.along < 0.0 ? nusselt_fma(rim.aside, rim.aside, rim.up * rim.up) / (rim.len - rim.along)
                                : rim.len + rim.along;
    // Quotients must stay finite.
    return volume * turn.jacobian / (rim.len * nusselt_max(sum, kNusseltEpsilon * kNusseltEpsilon * rim.len));
}

/// The solid angle of the sweep over the integral of rim_map_solid_density() over z.
float rim_map_solid_scale(const RimMap self) { return self.narrowing * self.slope * self.half_range; }

/// 1 minus the cosine of the angle of a point of the rim from the pole.
float rim_point_versine(const RimPoint rim) {
    // Next to the antipode, rounding may take the cosine below -1: by a percent where the point is on the rim.
    return versine_of(rim.sine, nusselt_min(nusselt_max(rim.cosine, -1.0), 1.0));
}

/// The place z in [-1, 1] at which the ray from the pole through a direction meets the rim.
float rim_map_place_of(const RimMap self, vec3 wi) {
    // The ray in the disk, scaled to order one.
    float upwards = nusselt_max(wi.z, 0.0);
    vec2 ray = vec2(dot(wi, self.h) - (self.shear / self.slope) * upwards, (self.narrowing / self.slope) * upwards);
    ray = reciprocal_power_of_two(nusselt_max(abs(ray.x), ray.y)) * ray;
    if (!(dot(ray, ray) > 0.0)) ray = vec2(0.0, 1.0);
    float squared = dot(ray, ray);

    // The larger root of the distance to the rim, in the form without cancellation.
    float along = nusselt_fma(self.pole, ray.x, -self.height * ray.y);
    float root = sqrt(nusselt_max(nusselt_fma(along, along, squared * self.power), 0.0));
    float reach = along <= 0.0 ? (root - along) / squared : self.power / (along + root);
    vec2 point = vec2(nusselt_fma(reach, ray.x, self.pole), nusselt_fma(reach, ray.y, -self.height));
    float zeta = rim_map_angle(self, point);
    return nusselt_min(nusselt_max(over_positive(zeta - self.left, self.half_range) - 1.0, -1.0), 1.0);
}

#endif
