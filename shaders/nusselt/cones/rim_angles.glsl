#ifndef NUSSELT_CONES_RIM_ANGLES_GLSL
#define NUSSELT_CONES_RIM_ANGLES_GLSL
// Follows include/nusselt/cones/rim_angles.h @ d3bd0ed84572
/// Angles around the rim of an elliptic cone in which densities of sweeps are smooth. Twin of
/// include/nusselt/cones/rim_angles.h.

#include "../cones/elliptic_cone.glsl"
#include "../core/trig.glsl"

/// 1 minus the cosine of an angle in [0, pi), relative to itself.
float versine_of(float sine, float cosine) { return cosine > 0.0 ? sine * sine / (1.0 + cosine) : 1.0 - cosine; }

struct RimAngles {
    float squeeze, stretch;
    vec2 mid;         ///< the reference after the squeeze, of unit length
    float mid_length; ///< by which the squeeze makes it longer
};

/// A point of the rim.
struct RimAnglesPoint {
    vec2 scaled;          ///< in the disk, times a length
    float inverse_length; ///< of that
    float across;         ///< the sine of the angle in the disk from the reference, accurate relative to itself
    float inverse_norm;   ///< one over the squared length of (x, s), see rim_angles_at()
    float jacobian;       ///< angle in the disk per angle of the map
};

/// The stretch is up to rim_angles_set_stretch().
/// \param lengths   a, b, c of the cone, c > 0
/// \param reference of unit length, in the disk.
RimAngles make_rim_angles(vec3 lengths, vec2 reference) {
    RimAngles self;
    float ratio = hypotenuse(lengths.y, lengths.z) / hypotenuse(lengths.x, lengths.z);
    self.squeeze = sqrt(ratio * sqrt(ratio));
    vec2 squeezed = vec2(reference.x, self.squeeze * reference.y);
    self.mid_length = hypotenuse(squeezed.x, squeezed.y);
    self.mid = (1.0 / self.mid_length) * squeezed;
    return self;
}

/// \param squared_cosine of half of the angle between pole and reference, positive.
void rim_angles_set_stretch(inout RimAngles self, float squared_cosine) { self.stretch = 1.0 / sqrt(squared_cosine); }

/// \param x the cosine of half of the angle of the map, times the stretch.
/// \param s the sine of it.
RimAnglesPoint rim_angles_at(const RimAngles self, float x, float s) {
    RimAnglesPoint point;
    point.inverse_norm = 1.0 / nusselt_fma(x, x, s * s);
    float cosine = (x - s) * (x + s) * point.inverse_norm;
    float sine = 2.0 * x * s * point.inverse_norm;
    point.scaled = vec2(self.squeeze, 1.0) * (cosine * self.mid + sine * vec2(-self.mid.y, self.mid.x));
    point.inverse_length = 1.0 / sqrt(dot(point.scaled, point.scaled));
    point.across = point.inverse_length * self.mid_length * sine;
    point.jacobian =
        (self.stretch * point.inverse_norm) * (self.squeeze * point.inverse_length * point.inverse_length);
    return point;
}

/// Sine and cosine of half of the angle of the map, times a length.
/// \param point  in the disk, of any length but 0.
/// \param across the sine of its angle from the reference, times its length.
vec2 rim_angles_half_of(const RimAngles self, vec2 point, float across) {
    vec2 squeezed = vec2(point.x, self.squeeze * point.y);
    float len = hypotenuse(squeezed.x, squeezed.y);
    float x = dot(squeezed, self.mid);
    float y = self.squeeze * abs(across) / self.mid_length;
    // The sum that does not cancel.
    return vec2(copysign(self.stretch * (x < 0.0 ? len - x : y), across), x < 0.0 ? y : len + x);
}

/// The angle of the map from rim_angles_half_of(), in [-pi, pi].
float rim_angle_of(vec2 half_turn) {
    return copysign(2.0 * atan2_positive(abs(half_turn.x), half_turn.y), half_turn.x);
}

#endif
