#ifndef NUSSELT_CONES_CONE_SOLID_ANGLE_GLSL
#define NUSSELT_CONES_CONE_SOLID_ANGLE_GLSL
// Follows include/nusselt/cones/cone_solid_angle.h @ 14cd2be6a5c7
// Follows include/nusselt/cones/spherical_ellipse.h @ 5f60bcdfbece
/// Sampling of the solid angle of ellipses and ellipsoids (disks and spheres: disk_light(), sphere_light()), for
/// surfaces and for volumes. Twin of include/nusselt/cones/cone_solid_angle.h, which has the measure and the edge
/// cases.
///
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.

#include "../cones/round_lights.glsl"
#include "../core/light_sample.glsl"
#include "../core/trig.glsl"

/// The density of the angle in a quadrant around the axis is linear between these nodes.
const int kNusseltQuadrantNodes = 8;

float quadrant_node(int i) {
    float t = float(i) * (1.0 / float(kNusseltQuadrantNodes - 1));
    return t * t * (3.0 - 2.0 * t);
}

struct ConeSolidAngle {
    RoundLightView view;
    vec2 sine, cosine; ///< of the half-angles
    float value[kNusseltQuadrantNodes];
    float below[kNusseltQuadrantNodes]; ///< integral from 0 to the node
    float measure, inverse_measure;
};

float cone_solid_angle_squared_sine(const ConeSolidAngle self, float cosine, float sine) {
    float x = self.sine.x * cosine;
    float y = self.sine.y * sine;
    return nusselt_min(nusselt_fma(x, x, y * y), 1.0);
}

/// By how much the cosine falls from the axis to the rim, over the squared sine there. From inside, it falls to -1.
float cone_solid_angle_drop(const ConeSolidAngle self, float cosine, float sine) {
    if (self.view.is_inside) return 2.0;
    return 1.0 / (1.0 + hypotenuse(self.cosine.x * cosine, self.cosine.y * sine));
}

ConeSolidAngle cone_solid_angle_of(const RoundLightView view) {
    ConeSolidAngle self;
    self.view = view;
    float a1 = hypotenuse(view.cone.a, view.cone.c);
    float b1 = hypotenuse(view.cone.b, view.cone.c);
    self.sine = vec2(over_positive(view.cone.a, a1), over_positive(view.cone.b, b1));
    self.cosine = vec2(over_positive(view.cone.c, a1), over_positive(view.cone.c, b1));
    self.value[0] = cone_solid_angle_drop(self, 1.0, 0.0);
    self.below[0] = 0.0;
    NUSSELT_UNROLL for (int i = 1; i < kNusseltQuadrantNodes; ++i) {
        SinCos turn = sincos_quarter_turn(kNusseltPi / 2.0 * quadrant_node(i));
        self.value[i] = cone_solid_angle_drop(self, turn.cosine, turn.sine);
        float width = quadrant_node(i) - quadrant_node(i - 1);
        self.below[i] = self.below[i - 1] + 0.5 * width * (self.value[i - 1] + self.value[i]);
    }
    float measure = 2.0 * kNusseltPi * (self.sine.x * self.sine.y) * self.below[kNusseltQuadrantNodes - 1];
    float inverse = 1.0 / (measure > 0.0 ? measure : 1.0);
    bool lit = view.cone.is_visible && measure > 0.0 && is_finite(inverse);
    self.measure = lit ? measure : 0.0;
    self.inverse_measure = lit ? inverse : 0.0;
    return self;
}
/// \param light relative to the shading point [m].
ConeSolidAngle cone_solid_angle_prepare(const Ellipse light) { return cone_solid_angle_of(view_of(light)); }
ConeSolidAngle cone_solid_angle_prepare(const Ellipsoid light) { return cone_solid_angle_of(view_of(light)); }

/// Estimate of the solid angle of the light [sr]: exact for spheres, else with a relative error below 1 %.
float cone_solid_angle_measure(const ConeSolidAngle self) { return self.measure; }

/// A piece of the linear density.
struct QuadrantSegment {
    float begin, width, left, right, below;
};

QuadrantSegment quadrant_segment(ConeSolidAngle self, int i) {
    float begin = quadrant_node(i);
    return QuadrantSegment(begin, quadrant_node(i + 1) - begin, self.value[i], self.value[i + 1], self.below[i]);
}

/// The piece that x in [0, 1] is in.
QuadrantSegment quadrant_segment_at(const ConeSolidAngle self, float x) {
    QuadrantSegment s = quadrant_segment(self, 0);
    NUSSELT_UNROLL for (int i = 1; i < kNusseltQuadrantNodes - 1; ++i) {
        if (x >= quadrant_node(i)) s = quadrant_segment(self, i);
    }
    return s;
}

/// A direction in the quadrant of positive coordinates.
struct QuadrantPlace {
    float x, cosine, sine, radius;
};

QuadrantPlace cone_solid_angle_place_of(const ConeSolidAngle self, vec3 wi) {
    float x = over_positive(abs(dot(wi, self.view.cone.e1)), self.sine.x);
    float y = over_positive(abs(dot(wi, self.view.cone.e2)), self.sine.y);
    float radius = hypotenuse(x, y);
    float inverse = over_positive(1.0, radius);
    float angle = (2.0 / kNusseltPi) * atan2_positive(y, x);
    return QuadrantPlace(nusselt_min(angle, 1.0), inverse > 0.0 ? x * inverse : 1.0, y * inverse, radius);
}

/// \param wi a unit direction towards the light.
float cone_solid_angle_pdf(const ConeSolidAngle self, vec3 wi) {
    QuadrantPlace place = cone_solid_angle_place_of(self, wi);
    QuadrantSegment s = quadrant_segment_at(self, place.x);
    float value = nusselt_fma((place.x - s.begin) / s.width, s.right - s.left, s.left);
    float density = value / cone_solid_angle_drop(self, place.cosine, place.sine) * self.inverse_measure;
    return is_finite(density) ? density : 0.0;
}

/// \param u in [0, 1)^2; u.x turns around the axis, u.y leads away from it. Continuous in both.
LightSample cone_solid_angle_sample(ConeSolidAngle self, vec2 u) {
    // Quadrants two and four are mirrored.
    float turns = 4.0 * u.x;
    float quadrant = nusselt_min(floor(turns), 3.0);
    float within = turns - quadrant;
    bool mirrored = quadrant == 1.0 || quadrant == 3.0;
    float goal = (mirrored ? 1.0 - within : within) * self.below[kNusseltQuadrantNodes - 1];
    QuadrantSegment s = quadrant_segment(self, 0);
    NUSSELT_UNROLL for (int i = 1; i < kNusseltQuadrantNodes - 1; ++i) {
        if (goal >= self.below[i]) s = quadrant_segment(self, i);
    }
    float rest = nusselt_max(goal - s.below, 0.0) / s.width;
    float root = sqrt(nusselt_max(nusselt_fma(2.0 * (s.right - s.left), rest, s.left * s.left), 0.0));
    float denominator = s.left + root;
    float share = 2.0 * rest / (denominator > 0.0 ? denominator : 1.0);
    float x = nusselt_fma(nusselt_min(share, 1.0), s.width, s.begin);
    SinCos turn = sincos_quarter_turn(kNusseltPi / 2.0 * x);
    vec2 direction = vec2(quadrant == 1.0 || quadrant == 2.0 ? -turn.cosine : turn.cosine,
                          quadrant >= 2.0 ? -turn.sine : turn.sine);

    // The cosine of the angle from the axis is uniform; its complement keeps small angles apart.
    float squared = cone_solid_angle_squared_sine(self, turn.cosine, turn.sine);
    float fall = u.y * cone_solid_angle_drop(self, turn.cosine, turn.sine);
    float radius = sqrt(nusselt_max(fall * (2.0 - squared * fall), 0.0));
    float cosine = 1.0 - squared * fall;
    EllipticCone cone = self.view.cone;
    vec3 wi = (radius * self.sine.x * direction.x) * cone.e1 + (radius * self.sine.y * direction.y) * cone.e2 +
              cosine * cone.e3;
    if (!(self.measure > 0.0)) wi = vec3(0.0, 0.0, 1.0);
    vec2 disk = over_positive(radius, cosine) * (self.cosine * direction);
    float distance = nusselt_max(dot(wi, round_light_point(self.view, disk, wi)), 0.0);
    return LightSample(wi, cone_solid_angle_pdf(self, wi), (self.view.inverse_scale * distance) * wi);
}

/// The random numbers for which the sample is wi, a unit direction on the light.
vec2 cone_solid_angle_invert(ConeSolidAngle self, vec3 wi) {
    QuadrantPlace place = cone_solid_angle_place_of(self, wi);
    QuadrantSegment s = quadrant_segment_at(self, place.x);
    float inside = (place.x - s.begin) / s.width;
    float below = nusselt_fma(s.width * inside, nusselt_fma(0.5 * inside, s.right - s.left, s.left), s.below);
    float share = over_positive(below, self.below[kNusseltQuadrantNodes - 1]);
    bool left = dot(wi, self.view.cone.e1) < 0.0;
    bool low = dot(wi, self.view.cone.e2) < 0.0;
    float turns = low ? (left ? 2.0 + share : 4.0 - share) : (left ? 2.0 - share : share);
    float up = 1.0 + dot(wi, self.view.cone.e3);
    // 1 - cosine over the squared sine at the rim is the squared radius over 1 + cosine.
    float fall = self.view.is_inside ? 2.0 - up : over_positive(place.radius * place.radius, up);
    return vec2(below_one(0.25 * turns), below_one(fall / cone_solid_angle_drop(self, place.cosine, place.sine)));
}

#endif
