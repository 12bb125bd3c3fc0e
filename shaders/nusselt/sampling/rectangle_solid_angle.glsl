#ifndef NUSSELT_SAMPLING_RECTANGLE_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_RECTANGLE_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/rectangle_solid_angle.h @ 558580cc94aa
/// Uniform sampling of the solid angle of a rectangle, without a seam.
///
/// C. Ureña, M. Fajardo, A. King 2013, An Area-Preserving Parametrization for Spherical Rectangles, CGF 32(4),
/// doi:10.1111/cgf.12151. Twin of include/nusselt/sampling/rectangle_solid_angle.h, where the deviations stand.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure.
/// Space: any frame with the shading point as origin; nothing is clipped.
/// Edge cases: no area, or origin in the plane of the rectangle: pdf = 0, measure 0.
///             An origin closer to the rectangle than 2^-60 of its size counts as being at that distance.

#include "../core/light_sample.glsl"
#include "../core/trig.glsl"
#include "../geometry/polygon_measures.glsl"

/// Farther than any point of a light with coordinates of order one.
const float kNusseltRectangleFar = 16.0;
/// The square of this distance, 2^-60, keeps all digits.
const float kNusseltRectangleNear = 8.673617379884035e-19;

struct RectangleSolidAngle {
    vec3 x_axis, y_axis, z_axis; ///< along the edges, and towards the plane
    float x0, x1, y0, y1;        ///< of the edges, scaled to an extent of order one; y0 + y1 >= 0
    float height;                ///< y1 - y0 before rounding
    float plane;                 ///< distance of the plane
    float left, right;           ///< solid angles of the strip beyond the light [sr]
    float upper, lower;          ///< angles of the upper and lower edge with the plane of the light
    float total;
    float inverse_total; ///< the density; 0 without light
    float inverse_scale; ///< a power of two
    bool mirrored;       ///< whether the y axis points against the second edge
};

/// Two points at (squared, v0) and (squared, v1): their distances, and v1 r0 - v0 r1.
struct RectangleChord {
    float r0, r1, twist;
};

/// \param squared distance of the line through the points from the origin.
/// \param extent  v1 - v0, not negative, before rounding of both.
RectangleChord rectangle_chord(float squared, float v0, float v1, float extent) {
    float r0 = sqrt(nusselt_fma(v0, v0, squared));
    float r1 = sqrt(nusselt_fma(v1, v1, squared));
    float twist;
    if (v0 * v1 > 0.0) twist = squared * extent * (v0 + v1) / nusselt_fma(v1, r0, v0 * r1);
    else twist = nusselt_fma(v1, r0, -v0 * r1);
    return RectangleChord(r0, r1, twist);
}

/// Solid angle of the part of the strip of all x from v0 to v1 between 0 and u.
float rectangle_corner(float u, float v0, float v1, float extent, float plane) {
    RectangleChord chord = rectangle_chord(nusselt_fma(u, u, plane * plane), v0, v1, extent);
    return atan2_positive(abs(u) * plane * nusselt_max(chord.twist, 0.0),
                          nusselt_fma(plane * plane, chord.r0 * chord.r1, u * u * (v0 * v1)));
}

/// Solid angle of a triangle with its doubled area times the distance of its plane. No dot product is negative where the
/// foot of the perpendicular is outside of both pairs of edges.
float rectangle_triangle(vec3 a, vec3 b, vec3 c, float product) {
    float ra = sqrt(dot(a, a));
    float rb = sqrt(dot(b, b));
    float rc = sqrt(dot(c, c));
    return 2.0 * atan2_positive(product, ra * rb * rc + dot(a, b) * rc + dot(a, c) * rb + dot(b, c) * ra);
}

/// Solid angle of [x0, x1] x [y0, y1] at the distance `plane`, with the exact lengths of the edges.
float rectangle_solid_angle_between(float x0, float x1, float width, float y0, float y1, float height, float plane) {
    // Two parts on both sides of the foot of the perpendicular, in the direction in which it is between the edges.
    if (y0 * y1 < 0.0) return rectangle_corner(y0, x0, x1, width, plane) + rectangle_corner(y1, x0, x1, width, plane);
    if (x0 * x1 < 0.0) return rectangle_corner(x0, y0, y1, height, plane) + rectangle_corner(x1, y0, y1, height, plane);
    vec3 a = vec3(x0, y0, plane);
    vec3 c = vec3(x1, y1, plane);
    float product = width * height * plane;
    return rectangle_triangle(a, vec3(x1, y0, plane), c, product) + rectangle_triangle(a, vec3(x0, y1, plane), c, product);
}

/// Solid angle of the strip between the lines of the upper and the lower edge beyond x >= 0: a spherical triangle, with the
/// point at infinity as its third vertex.
float rectangle_strip(const RectangleSolidAngle self, float x) {
    float squared = nusselt_fma(x, x, self.plane * self.plane);
    RectangleChord chord = rectangle_chord(squared, self.y0, self.y1, self.height);
    float radii = chord.r0 * chord.r1;
    float product = self.y0 * self.y1;
    float cosines = radii + product;
    if (product < 0.0)
        cosines = squared * (squared + nusselt_fma(self.y0, self.y0, self.y1 * self.y1)) / (radii - product);
    return 2.0 * atan2_positive(self.height * self.plane, cosines + nusselt_fma(x, chord.r0 + chord.r1, squared));
}

/// \param light relative to the shading point, either winding [m]. A rectangle up to rounding; other polygons give samples
///              that miss the light.
RectangleSolidAngle rectangle_solid_angle_prepare(const ConvexPolygon light) {
    RectangleSolidAngle self;
    self.inverse_scale = reciprocal_power_of_two(unit_extent_scale(light));
    ConvexPolygon unit = with_unit_extent(light);
    vec3 corner = unit.vertex[0];
    vec3 first = unit.edge[0];
    vec3 second = unit.edge[1];

    // Measure along the edges, from the foot of the perpendicular. Rounding of the edges must not turn one axis into
    // another: a light far away would move by that angle times its distance.
    self.x_axis = inverse_length(first) * first;
    vec3 across = nusselt_fma(-dot(second, self.x_axis), self.x_axis, second);
    self.y_axis = inverse_length(across) * across;
    vec3 normal = nusselt_cross(self.x_axis, self.y_axis);
    float signed_distance = plane_distance(unit) == 0.0 ? 0.0 : dot(corner, normal);
    self.plane = abs(signed_distance);
    self.z_axis = signed_distance >= 0.0 ? normal : -normal;
    float width = nusselt_length(first);
    self.height = nusselt_length(second);
    // The edge that is farther from the foot gets the positive y axis.
    self.x0 = dot(corner, self.x_axis);
    self.x1 = self.x0 + width;
    float low = dot(corner, self.y_axis);
    float high = low + self.height;
    self.mirrored = low + high < 0.0;
    self.y0 = self.mirrored ? -high : low;
    self.y1 = self.mirrored ? -low : high;
    self.y_axis = self.mirrored ? -self.y_axis : self.y_axis;
    // Next to the light, squares of distances would underflow. Rounding of its vertices moves it farther than this.
    float beside = nusselt_max(nusselt_max(self.x0, -self.x1), nusselt_max(self.y0, -self.y1));
    if (self.plane > 0.0 && beside < kNusseltRectangleNear) self.plane = nusselt_max(self.plane, kNusseltRectangleNear);

    self.total = 0.0;
    if (self.plane > 0.0 && nusselt_min(width, self.height) > 0.0)
        self.total = rectangle_solid_angle_between(self.x0, self.x1, width, self.y0, self.y1, self.height, self.plane);
    float density = 1.0 / (self.total > 0.0 ? self.total : 1.0);
    bool lit = self.total > 0.0 && is_finite(density);
    self.total = lit ? self.total : 0.0;
    self.inverse_total = lit ? density : 0.0;

    // The strip beyond both ends of the light, and the angles of its edges with the plane of the light.
    float middle = rectangle_strip(self, 0.0);
    float beyond0 = rectangle_strip(self, abs(self.x0));
    float beyond1 = rectangle_strip(self, abs(self.x1));
    self.left = self.x0 <= 0.0 ? beyond0 : nusselt_fma(2.0, middle, -beyond0);
    self.right = self.x1 >= 0.0 ? beyond1 : nusselt_fma(2.0, middle, -beyond1);
    self.upper = atan2_positive(self.plane, self.y1);
    self.lower = atan2_positive(self.plane, -self.y0);
    return self;
}

/// The sine of two angles that sum up to pi, by the smaller one.
float rectangle_sine(float angle, float supplement) {
    return sincos_quarter_turn(nusselt_max(nusselt_min(angle, supplement), 0.0)).sine;
}

/// \param u in [0, 1)^2; u.x moves along the first edge of the light, u.y across it. Continuous in both.
LightSample rectangle_solid_angle_sample(const RectangleSolidAngle self, vec2 u) {
    // Of the strip between the lines of the upper and the lower edge, p is the solid angle to the left of x and q that to
    // the right of it. Their halves sum up to the angle between the planes of the lines.
    float p = 0.5 * nusselt_fma(u.x, self.total, self.left);
    float q = 0.5 * nusselt_fma(1.0 - u.x, self.total, self.right);
    // With these x = distance sin(p - q) / (2 sqrt(sin p sin q sin(p + upper) sin(q + upper))). Each sine is that of the
    // smaller one of two angles that sum up to pi: there it keeps its digits.
    float outside = self.upper + self.lower;
    float sines_pq = rectangle_sine(p, outside + q) * rectangle_sine(q, outside + p);
    float sines_edges = rectangle_sine(self.upper + p, self.lower + q) * rectangle_sine(self.upper + q, self.lower + p);
    float denominator = 2.0 * sqrt(sines_pq) * sqrt(sines_edges);
    float numerator = self.plane * rectangle_sine(abs(p - q), outside + 2.0 * nusselt_min(p, q));
    float magnitude = denominator > 0.0 ? numerator / denominator : kNusseltRectangleFar; // beyond the light: its end
    float x = nusselt_min(nusselt_max(p >= q ? magnitude : -magnitude, self.x0), self.x1);

    // The sine h of the elevation of y above the plane y = 0 is uniform. Its distances from 1 and -1 are sums.
    float v = self.mirrored ? 1.0 - u.y : u.y;
    float rest = self.mirrored ? u.y : 1.0 - u.y;
    float squared = nusselt_fma(x, x, self.plane * self.plane);
    RectangleChord chord = rectangle_chord(squared, self.y0, self.y1, self.height);
    float h0 = self.y0 / chord.r0;
    float range = chord.twist / (chord.r0 * chord.r1);
    float below_one = squared / (chord.r1 * (chord.r1 + self.y1)); // 1 - h1; y1 is not negative
    float above_minus_one = self.y0 < 0.0 ? squared / (chord.r0 * (chord.r0 - self.y0)) : 1.0 + h0;
    float cosine2 = nusselt_fma(rest, range, below_one) * nusselt_fma(v, range, above_minus_one);
    float height = nusselt_fma(v, range, h0) * sqrt(squared / (cosine2 > 0.0 ? cosine2 : 1.0));
    float y = nusselt_min(nusselt_max(height, self.y0), self.y1);

    vec3 at = self.z_axis;
    if (self.inverse_total > 0.0)
        at = nusselt_fma(x, self.x_axis, nusselt_fma(y, self.y_axis, self.plane * self.z_axis));
    return LightSample(inverse_length(at) * at, self.inverse_total, self.inverse_scale * at);
}

/// Constant on the light; the caller knows that wi hits it.
float rectangle_solid_angle_pdf(const RectangleSolidAngle self, vec3 wi) { return self.inverse_total; }

/// The random numbers for which rectangle_solid_angle_sample() returns wi, a unit direction on the light.
vec2 rectangle_solid_angle_invert(const RectangleSolidAngle self, vec3 wi) {
    float ahead = dot(wi, self.z_axis);
    float along = self.plane / (ahead > 0.0 ? ahead : 1.0);
    float x = nusselt_min(nusselt_max(along * dot(wi, self.x_axis), self.x0), self.x1);
    float y = nusselt_min(nusselt_max(along * dot(wi, self.y_axis), self.y0), self.y1);
    float part = rectangle_solid_angle_between(self.x0, x, x - self.x0, self.y0, self.y1, self.height, self.plane);
    float squared = nusselt_fma(x, x, self.plane * self.plane);
    RectangleChord whole = rectangle_chord(squared, self.y0, self.y1, self.height);
    RectangleChord begun = rectangle_chord(squared, self.y0, y, y - self.y0);
    float all = whole.twist * begun.r1;
    float share = begun.twist * whole.r1 / (all > 0.0 ? all : 1.0);
    float second = self.mirrored ? 1.0 - share : share;
    return vec2(below_one(nusselt_min(nusselt_max(part * self.inverse_total, 0.0), 1.0)),
                below_one(nusselt_min(nusselt_max(second, 0.0), 1.0)));
}

/// Solid angle of the light [sr].
float rectangle_solid_angle_measure(const RectangleSolidAngle self) { return self.total; }

#endif
