#ifndef NUSSELT_SAMPLING_POLYGON_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_POLYGON_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/polygon_solid_angle.h @ fb5edaa204db
/// Uniform sampling of the solid angle of a convex polygon, for surfaces and for volumes.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672: Sec. 5,
/// supplement C re-derived. The map equals that of Arvo 1995. Twin of include/nusselt/sampling/polygon_solid_angle.h,
/// where the deviations stand.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], the constant 1 / measure.
/// Space: any frame with the shading point as origin; nothing is clipped.
/// Edge cases: no area, or origin in the plane of the polygon: pdf = 0, measure 0.

#include "../core/light_sample.glsl"
#include "../geometry/fan_volumes.glsl"
#include "../geometry/polygon_measures.glsl"

/// Least value of 1 + the cosine of two directions: the sum of opposite ones is lost to rounding.
const float kNusseltOpposite = kNusseltEpsilon * kNusseltEpsilon;
/// Vertices that are not closer are normalised without scaling; nor those that are closer than the reciprocal.
const float kNusseltNear = 1.0 / 1048576.0;
/// Thresholds whose reasons are in include/nusselt/sampling/polygon_solid_angle.h.
const float kNusseltNearby = 0.125;
const float kNusseltMuchSharper = 4.0;
const float kNusseltFlattest = 16.0;
/// Squared sine of the angle at vertex 0 below which a triangle is a sliver.
const float kNusseltSliver = 1.0 / 256.0;
/// The least number whose reciprocal is finite.
const float kNusseltLeast = 4.0 * kNusseltSmallestNormal;

struct PolygonSolidAngle {
    vec3 vertex[kNusseltSlots];            ///< [m] or, for very large and very small lights, in a unit of order one
    float inverse_distance[kNusseltSlots]; ///< of the vertices
    float inverse_scale;                   ///< from the unit to metres, a power of two
    // For each triangle, with unit directions a, b, c to vertices j + 1, j + 2 and 0:
    float g0[kNusseltSlots - 2];           ///< triple product, not negative
    float g1[kNusseltSlots - 2];           ///< 1 + dot(a, b) + dot(a, c) + dot(b, c)
    float g2[kNusseltSlots - 1];           ///< 1 + dot(a, c)
    float one_plus_ab[kNusseltSlots - 2];  ///< 1 + dot(a, b)
    float begin[kNusseltSlots - 2];        ///< solid angle of the triangles before
    float total;
    float inverse_total;   ///< the density; 0 without light
    bool wide;             ///< some directions differ by more than a right angle, or the light surrounds the point
    bool counterclockwise; ///< winding as seen along a ray from the origin through the polygon
};

vec3 polygon_solid_angle_direction(PolygonSolidAngle self, int j) {
    return self.inverse_distance[j] * self.vertex[j];
}

/// \param polygon          in a unit of order one or in metres.
/// \param inverse_distance of its vertices.
/// \param inverse_scale    from the unit to metres.
PolygonSolidAngle polygon_solid_angle_prepare_volumes(const ConvexPolygon polygon,
                                                      float inverse_distance[kNusseltSlots],
                                                      float inverse_scale, FanVolumes volumes) {
    PolygonSolidAngle self;
    self.vertex = polygon.vertex;
    self.inverse_distance = inverse_distance;
    self.inverse_scale = inverse_scale;

    // Sum up directions: the squared length of such a sum is 2 + twice the cosine.
    vec3 sum[kNusseltSlots - 1];
    vec3 c = polygon_solid_angle_direction(self, 0);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 1; ++j) {
        sum[j] = polygon_solid_angle_direction(self, j + 1) + c;
        self.g2[j] = 0.5 * dot(sum[j], sum[j]);
    }

    // The terms of Eq. 13. Where two directions are almost opposite, cosines lose what is left of their sum.
    float least = self.g2[kNusseltSlots - 2];
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        // One distance after the other: their product might leave the range. Where a vertex is almost at the origin,
        // rounding of edges, divided by its distance, would exceed any triple product of unit vectors.
        self.g0[j] = nusselt_min(
            abs(volumes.volume[j]) * inverse_distance[0] * inverse_distance[j + 1] * inverse_distance[j + 2], 1.0);
        self.g1[j] = dot(sum[j], sum[j + 1]);
        self.one_plus_ab[j] = (self.g1[j] - self.g2[j]) + (2.0 - self.g2[j + 1]);
        least = nusselt_min(least, nusselt_min(self.g2[j], nusselt_min(self.g1[j], self.one_plus_ab[j])));
    }
    self.wide = least < 0.25;

    // The solid angles (Eq. 13).
    float angle[kNusseltSlots - 2]; // halves
    if (self.wide) {
        NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
            vec3 ab = polygon_solid_angle_direction(self, j + 1) + polygon_solid_angle_direction(self, j + 2);
            float ab2 = dot(ab, ab);
            float ac2 = dot(sum[j], sum[j]);
            float bc2 = dot(sum[j + 1], sum[j + 1]);
            // Any two of the three sums have the product 1 + a b + a c + b c; the longest one would cancel most.
            vec3 s0 = ac2 >= ab2 && ac2 >= bc2 ? ab : sum[j];
            vec3 s1 = bc2 > ab2 && bc2 > ac2 ? ab : sum[j + 1];
            self.g1[j] = dot(s0, s1);
            self.g2[j] = nusselt_max(self.g2[j], kNusseltOpposite);
            self.one_plus_ab[j] = nusselt_max(0.5 * ab2, kNusseltOpposite);
            angle[j] = 0.0;
            if (self.g0[j] > 0.0) angle[j] = atan2_positive(self.g0[j], self.g1[j]);
        }
    } else {
        NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
            float octant = atan_up_to_one(nusselt_min(self.g0[j], self.g1[j]) / nusselt_max(self.g0[j], self.g1[j]));
            angle[j] = self.g0[j] > self.g1[j] ? 0.5 * kNusseltPi - octant : octant;
        }
    }
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        self.begin[j] = self.total;
        self.total = self.total + (angle[j] + angle[j]);
    }
    self.inverse_total = 0.0;
    if (self.total > kNusseltLeast) self.inverse_total = 1.0 / self.total;
    self.counterclockwise = volumes.total >= 0.0;
    return self;
}

/// \param polygon         with coordinates of order one.
/// \param inverse_scale   from there to the light.
/// \param signed_distance of the plane of the polygon from the origin, see plane_distance().
PolygonSolidAngle polygon_solid_angle_prepare_scaled(ConvexPolygon polygon, float inverse_scale,
                                                     float signed_distance) {
    // A vertex at the origin implies that no triangle has a solid angle; any direction will do.
    float inverse_distance[kNusseltSlots];
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) inverse_distance[j] = inverse_length(polygon.vertex[j]);
    return polygon_solid_angle_prepare_volumes(polygon, inverse_distance, inverse_scale,
                                               fan_volumes(polygon, signed_distance));
}

/// \param light relative to the shading point, either winding [m]. Nothing is clipped.
PolygonSolidAngle polygon_solid_angle_prepare(ConvexPolygon light) {
    FanVolumes volumes = fan_volumes(light);
    float inverse_distance[kNusseltSlots];
    float nearest = dot(light.vertex[0], light.vertex[0]); // squared distances
    float farthest = nearest;
    inverse_distance[0] = 1.0 / sqrt(nearest);
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots; ++j) {
        float squared = dot(light.vertex[j], light.vertex[j]);
        inverse_distance[j] = 1.0 / sqrt(squared);
        nearest = nusselt_min(nearest, squared);
        farthest = nusselt_max(farthest, squared);
    }
    float inverse_scale = 1.0;
    bool in_range = nearest > kNusseltNear * kNusseltNear && farthest < 1.0 / (kNusseltNear * kNusseltNear);
    if (!(volumes.conclusive && in_range)) {
        if (!in_range) {
            // Products might leave the range.
            inverse_scale = reciprocal_power_of_two(unit_extent_scale(light));
            light = with_unit_extent(light);
            volumes = fan_volumes(light);
            NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) inverse_distance[j] = inverse_length(light.vertex[j]);
        }
        if (!volumes.conclusive) volumes = fan_volumes_refined(light);
    }
    return polygon_solid_angle_prepare_volumes(light, inverse_distance, inverse_scale, volumes);
}

/// Solid angle of the light [sr].
float polygon_solid_angle_measure(const PolygonSolidAngle self) { return self.total; }

/// Constant on the light; the caller knows that wi hits it.
float polygon_solid_angle_pdf(const PolygonSolidAngle self, vec3 wi) { return self.inverse_total; }

/// The largest distance of a vertex [m].
float polygon_solid_angle_reach(PolygonSolidAngle self) {
    // Vertices at the origin have a reciprocal distance of 0.
    float least = kNusseltLargest;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        if (self.inverse_distance[j] > 0.0) least = nusselt_min(least, self.inverse_distance[j]);
    }
    return self.inverse_scale / least;
}

/// The part of a sample that depends on its triangle, with unit directions a, b, c as in PolygonSolidAngle.
struct SolidAngleTriangle {
    vec3 pa, pb; ///< vertices
    float inverse_a, inverse_b;
    float g0, g1, g2_a, one_plus_ab;
};

/// The great circle of a sample through c and v where v may be almost opposite to c, as for lights that fill a hemisphere.
/// The derivation is in include/nusselt/sampling/polygon_solid_angle.h.
struct WideCircle {
    vec3 tangent;    ///< of the circle at c, towards v, of any length
    float sharpness; ///< small if a is almost on one line with b, or opposite to c
};

/// \param angle half of the solid angle of the triangle (a, c, v).
WideCircle polygon_solid_angle_wide_circle(const PolygonSolidAngle self, const SolidAngleTriangle t,
                                           const SinCos angle) {
    vec3 a = t.inverse_a * t.pa;
    vec3 n = (t.inverse_a * t.inverse_b) * nusselt_cross(t.pa, t.pb);
    float squared = dot(n, n);
    float sine = sqrt(squared);
    float q = nusselt_fma(-t.g2_a, t.one_plus_ab, t.g1);
    float x = nusselt_fma(t.g0, angle.cosine, -q * angle.sine);
    float y = sine * t.g2_a * angle.sine;
    float double_sine = 2.0 * angle.sine * angle.cosine;
    float double_cosine = nusselt_fma(angle.cosine, angle.cosine, -angle.sine * angle.sine);
    float upright =
        nusselt_fma(double_sine, nusselt_fma(t.g2_a, squared, -t.g0 * t.g0), -t.g0 * q * double_cosine);
    float side = self.counterclockwise ? -1.0 : 1.0;
    vec3 normal = (side * upright) * n + (2.0 * x * y * sine) * a + (y * y - x * x) * nusselt_cross(n, a);
    return WideCircle(side * nusselt_cross(normal, polygon_solid_angle_direction(self, 0)),
                      nusselt_min(sine, sqrt(t.g2_a)));
}

/// A unit direction on the circle.
/// \param drop, rest one minus and one plus the cosine of its angle with c.
vec3 wide_circle_direction(const WideCircle self, float drop, float rest, vec3 c) {
    float rise = sqrt(nusselt_max(drop * rest, 0.0));
    vec3 wi = (1.0 - drop) * c + (rise * inverse_length(self.tangent)) * self.tangent;
    return inverse_length(wi) * wi;
}

/// Distance of the plane of a triangle along a unit direction [m]; the largest number if rounding relative to the reach of
/// the light would move that point by more: if the triangle is a sliver, or its plane is seen too flat.
float polygon_solid_angle_distance_along(const PolygonSolidAngle self, vec3 wi, const SolidAngleTriangle t,
                                         float reach) {
    vec3 to_a = t.pa - self.vertex[0];
    vec3 to_b = t.pb - self.vertex[0];
    vec3 normal = nusselt_cross(to_a, to_b);
    float squared = dot(normal, normal);
    float volume = t.g0 / (t.inverse_a * t.inverse_b * self.inverse_distance[0]);
    float cosine = nusselt_max(abs(dot(normal, wi)), kNusseltLeast);
    float along = self.inverse_scale * volume / cosine;
    bool known = squared > kNusseltSliver * dot(to_a, to_a) * dot(to_b, to_b);
    bool upright = along * sqrt(squared) < kNusseltFlattest * reach * cosine;
    return known && upright ? along : kNusseltLargest;
}

/// \param u in [0, 1)^2; x selects the great circle through vertex 0, y the point on it, beginning at vertex 0.
LightSample polygon_solid_angle_sample(PolygonSolidAngle self, vec2 u) {
    // Choose a triangle of the fan in proportion to its solid angle (Sec. 5).
    float target = u.x * self.total;
    SolidAngleTriangle t = SolidAngleTriangle(self.vertex[1], self.vertex[2], self.inverse_distance[1],
                                              self.inverse_distance[2], self.g0[0], self.g1[0], self.g2[0],
                                              self.one_plus_ab[0]);
    float g2_b = self.g2[1];
    float begin = 0.0;
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots - 2; ++j) {
        if (target >= self.begin[j]) {
            t = SolidAngleTriangle(self.vertex[j + 1], self.vertex[j + 2], self.inverse_distance[j + 1],
                                   self.inverse_distance[j + 2], self.g0[j], self.g1[j], self.g2[j],
                                   self.one_plus_ab[j]);
            g2_b = self.g2[j + 1];
            begin = self.begin[j];
        }
    }

    // The corner v, on the arc from a to b, for which the triangle (a, c, v) has the remaining solid angle (Eq. 14). It
    // is the mirror image of a at the direction r = excess a + y (a + b), of any length.
    float half_angle = 0.5 * (target - begin);
    SinCos angle;
    if (self.wide)
        angle = sincos_half_turn(half_angle);
    else
        angle = sincos_quarter_turn(half_angle);
    float excess = nusselt_max(nusselt_fma(t.g0, angle.cosine, -t.g1 * angle.sine), 0.0);
    float y = t.g2_a * angle.sine;
    if (!(excess + y > 1.0 / 16777216.0)) {
        float scale = reciprocal_power_of_two(nusselt_max(excess, y));
        excess = scale * excess;
        y = scale * y;
    }
    float twice_y = y + y;
    float ky = t.one_plus_ab * twice_y;
    float squared = nusselt_max(nusselt_fma(excess, excess, ky * (excess + y)), kNusseltLeast); // of |r|
    float inverse_squared = 1.0 / squared;

    // What follows in terms of |r|^2: v as a weighted sum of a and b, c v, and 1 - c v and 1 + c v.
    float weight_a = excess * (excess + twice_y);
    float weight_b = nusselt_fma(twice_y, excess, ky * y);
    float cosine = nusselt_fma(weight_a, t.g2_a - 1.0, weight_b * (g2_b - 1.0));
    float depth = squared - cosine;
    float room = squared + cosine;
    vec3 c = polygon_solid_angle_direction(self, 0);
    vec3 cv = vec3(0.0);
    if (self.wide) {
        // Weights may be large and cancel. Find v from the sum of a and b, which is then small but accurate.
        vec3 a = t.inverse_a * t.pa;
        vec3 ab = a + t.inverse_b * t.pb;
        vec3 v = (inverse_squared * nusselt_fma(excess, excess, -ky * y)) * a + (inverse_squared * weight_b) * ab;
        vec3 chord = v - c;
        cv = v + c;
        depth = squared * (0.5 * dot(chord, chord));
        room = nusselt_max(squared * nusselt_max(0.5 * dot(cv, cv), kNusseltOpposite), kNusseltLeast);
    }

    // The point on the arc from c to v, whose cosine with c is uniform (Arvo 1995).
    float tau = sqrt(u.y * nusselt_fma(u.y, room, (2.0 - (u.y + u.y)) * squared) / room);
    depth = inverse_squared * depth;

    // Add the vertices with the weights of their directions, divided by their distances. The sum has the sampled direction
    // and length one up to rounding; divided by the sum of the weights, it is a point of the light.
    float at_v = tau * inverse_squared;
    float at_a = at_v * weight_a * t.inverse_a;
    float at_b = at_v * weight_b * t.inverse_b;
    float at_c = nusselt_max(nusselt_fma(depth, tau - u.y, 1.0 - tau), 0.0) * self.inverse_distance[0];
    vec3 sum = at_a * t.pa + at_b * t.pb + at_c * self.vertex[0];
    float to_light = self.inverse_scale / nusselt_max(at_a + at_b + at_c, kNusseltLeast);
    vec3 p = to_light * sum;
    if (self.wide) {
        float drop = u.y * depth;
        vec3 wi = nusselt_fma(-tau, inverse_squared * room, 1.0 - drop) * c + tau * cv;
        wi = inverse_length(wi) * wi;
        // From close by, rounding relative to the size of the light would turn the point away from the direction.
        float reach = polygon_solid_angle_reach(self);
        float along = dot(p, wi);
        if (along < kNusseltNearby * reach) p = along * wi;

        // Rounding turns the circle by eps / sharpness, and the direction by way of the corner by eps / |c + v|.
        WideCircle circle = polygon_solid_angle_wide_circle(self, t, angle);
        // A triangle that fills much of a hemisphere has a solid angle of more than a quarter of it.
        if (t.g0 > t.g1 && circle.sharpness * circle.sharpness > kNusseltMuchSharper * kNusseltMuchSharper * dot(cv, cv)) {
            float rest = nusselt_fma(u.y, inverse_squared * room, 2.0 - (u.y + u.y));
            vec3 on_circle = wide_circle_direction(circle, drop, rest, c);
            along = polygon_solid_angle_distance_along(self, on_circle, t, reach);
            if (along < nusselt_min(circle.sharpness, kNusseltNearby) * reach) {
                wi = on_circle;
                p = along * wi;
            }
        }
        return LightSample(wi, self.inverse_total, p);
    }
    // One step of Newton's iteration normalises a vector that is almost normalised.
    float length2 = dot(sum, sum);
    float factor = nusselt_fma(-0.5, length2, 1.5);
    if (!(abs(length2 - 1.0) < 1.0 / 2048.0)) factor = inverse_length(sum);
    return LightSample(factor * sum, self.inverse_total, p);
}

/// The random numbers for which the sample is wi, a unit direction on the light; (0, 0) at vertex 0.
vec2 polygon_solid_angle_invert(PolygonSolidAngle self, vec3 wi) {
    vec3 c = polygon_solid_angle_direction(self, 0);
    vec3 n = nusselt_cross(c, wi); // of the great circle through c and wi
    vec3 to_wi = wi - c;
    bool found = self.total <= 0.0;
    vec2 u = vec2(0.0);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        // The last triangle also has what rounding moved beyond it.
        float end = j + 3 < kNusseltSlots ? self.begin[j + 3 < kNusseltSlots ? j + 1 : j] : self.total;
        float solid_angle = end - self.begin[j];
        if (!found && solid_angle > 0.0) {
            vec3 a = polygon_solid_angle_direction(self, j + 1);
            vec3 b = polygon_solid_angle_direction(self, j + 2);
            float to_b = self.counterclockwise ? dot(n, b) : -dot(n, b);
            float from_a = self.counterclockwise ? -dot(n, a) : dot(n, a);
            // The arc meets the edge at v = (weight_a a + weight_b b) / |...|.
            float weight_a = nusselt_max(to_b, 0.0);
            float weight_b = nusselt_max(from_a, 0.0);
            vec3 sum = weight_a * a + weight_b * b;
            float norm = sqrt(dot(sum, sum));
            float inverse_norm = 1.0 / (norm > 0.0 ? norm : 1.0);
            vec3 v = inverse_norm * sum;
            float partial_angle = 2.0 * atan2_positive(self.g0[j] * weight_b * inverse_norm,
                                                       1.0 + dot(a, c) + dot(a, v) + dot(c, v));
            vec3 to_v = v - c;
            float whole = dot(to_v, to_v);
            u.x = self.begin[j] + nusselt_min(partial_angle, solid_angle);
            u.y = dot(to_wi, to_wi) / (whole > 0.0 ? whole : 1.0);
            found = to_b > 0.0;
        }
    }
    return vec2(below_one(u.x / (self.total > 0.0 ? self.total : 1.0)), below_one(u.y));
}

#endif
