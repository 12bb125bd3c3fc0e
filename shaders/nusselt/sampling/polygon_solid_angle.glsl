#ifndef NUSSELT_SAMPLING_POLYGON_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_POLYGON_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/polygon_solid_angle.h @ ca93e5fccb57
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
#include "../geometry/polygon_measures.glsl"

/// Least value of 1 + the cosine of two directions: the sum of opposite ones is lost to rounding.
const float kNusseltOpposite = kNusseltEpsilon * kNusseltEpsilon;

struct PolygonSolidAngle {
    vec3 vertex[kNusseltSlots];            ///< scaled to coordinates of order one
    vec3 direction[kNusseltSlots];         ///< unit vectors to the vertices
    float inverse_distance[kNusseltSlots]; ///< of the scaled vertices
    float inverse_scale;                   ///< a power of two
    float g0[kNusseltSlots - 2];           ///< triple product of the directions
    float g1[kNusseltSlots - 2];           ///< 1 + dot(a, b) + dot(a, c) + dot(b, c)
    float g2[kNusseltSlots - 2];           ///< 1 + dot(a, c)
    float solid_angle[kNusseltSlots - 2];
    float total;
    float inverse_total;   ///< the density; 0 without light
    bool counterclockwise; ///< winding as seen along a ray from the origin through the polygon
};

/// \param polygon         with coordinates of order one.
/// \param inverse_scale   from there to the light.
/// \param signed_distance of the plane of the polygon from the origin, see plane_distance().
PolygonSolidAngle polygon_solid_angle_prepare_scaled(ConvexPolygon polygon, float inverse_scale,
                                                     float signed_distance) {
    PolygonSolidAngle self;
    self.inverse_scale = inverse_scale;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        self.vertex[j] = polygon.vertex[j];
        // A vertex at the origin implies that no triangle has a solid angle; any direction will do.
        self.inverse_distance[j] = inverse_length(polygon.vertex[j]);
        self.direction[j] = self.inverse_distance[j] * polygon.vertex[j];
    }
    self.counterclockwise = signed_distance >= 0.0;
    vec3 offset = polygon.edge[0];
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        vec3 a = self.direction[j + 1];
        vec3 c = self.direction[0];
        vec3 b = self.direction[j + 2];
        float doubled_area = abs(dot(polygon.normal, nusselt_cross(offset, polygon.edge[j + 1])));
        self.g0[j] = abs(signed_distance) * doubled_area * self.inverse_distance[0] * self.inverse_distance[j + 1] *
                     self.inverse_distance[j + 2];
        // Two of three directions may be almost opposite: cosines would lose what is left of their sum.
        vec3 ab = a + b;
        vec3 ac = a + c;
        vec3 bc = b + c;
        float ab2 = dot(ab, ab);
        float ac2 = dot(ac, ac);
        float bc2 = dot(bc, bc);
        // Any two of the three sums have the product 1 + a b + a c + b c; the longest one would cancel most.
        vec3 s0 = ac2 >= ab2 && ac2 >= bc2 ? ab : ac;
        vec3 s1 = bc2 > ab2 && bc2 > ac2 ? ab : bc;
        self.g1[j] = dot(s0, s1);
        self.g2[j] = nusselt_max(0.5 * ac2, kNusseltOpposite);
        self.solid_angle[j] = 0.0;
        if (self.g0[j] > 0.0) self.solid_angle[j] = 2.0 * atan2_positive(self.g0[j], self.g1[j]);
        self.total = self.total + self.solid_angle[j];
        offset = offset + polygon.edge[j + 1];
    }
    float density = 1.0 / (self.total > 0.0 ? self.total : 1.0);
    self.inverse_total = self.total > 0.0 && is_finite(density) ? density : 0.0;
    return self;
}

/// \param light relative to the shading point, either winding [m]. Nothing is clipped.
PolygonSolidAngle polygon_solid_angle_prepare(ConvexPolygon light) {
    ConvexPolygon polygon = with_unit_extent(light);
    return polygon_solid_angle_prepare_scaled(polygon, reciprocal_power_of_two(unit_extent_scale(light)),
                                              plane_distance(polygon));
}

/// Solid angle of the light [sr].
float polygon_solid_angle_measure(PolygonSolidAngle self) { return self.total; }

/// Constant on the light; the caller knows that wi hits it.
float polygon_solid_angle_pdf(PolygonSolidAngle self, vec3 wi) { return self.inverse_total; }

/// A triangle of the fan; c is vertex 0 of the polygon, a and b are consecutive vertices.
struct SolidAngleTriangle {
    vec3 a, b;                   ///< unit directions
    vec3 pa, pb;                 ///< vertices
    float inverse_a, inverse_b;  ///< reciprocal distances
    float g0, g1, g2;            ///< terms of Eq. 13
    float solid_angle;
};

SolidAngleTriangle polygon_solid_angle_triangle(PolygonSolidAngle self, int j) {
    return SolidAngleTriangle(self.direction[j + 1], self.direction[j + 2], self.vertex[j + 1], self.vertex[j + 2],
                              self.inverse_distance[j + 1], self.inverse_distance[j + 2], self.g0[j], self.g1[j],
                              self.g2[j], self.solid_angle[j]);
}

/// \param u in [0, 1)^2; x selects the great circle through vertex 0, y the point on it, beginning at vertex 0.
LightSample polygon_solid_angle_sample(PolygonSolidAngle self, vec2 u) {
    float target = u.x * self.total;
    SolidAngleTriangle t = polygon_solid_angle_triangle(self, 0);
    float begin = 0.0;
    float before = self.solid_angle[0];
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots - 2; ++j) {
        if (self.solid_angle[j] > 0.0 && target >= before) {
            t = polygon_solid_angle_triangle(self, j);
            begin = before;
        }
        before = before + self.solid_angle[j];
    }
    float part = nusselt_min(nusselt_max(target - begin, 0.0), t.solid_angle);

    // The corner v of the sub-triangle (a, c, v) with that solid angle, v on the arc from a to b.
    SinCos half_angle = sincos_half_turn(0.5 * part);
    vec3 ab = t.a + t.b;
    float one_plus_ab = nusselt_max(0.5 * dot(ab, ab), kNusseltOpposite);
    float excess = nusselt_max(nusselt_fma(t.g0, half_angle.cosine, -t.g1 * half_angle.sine), 0.0);
    float y = t.g2 * half_angle.sine;
    float scale = reciprocal_power_of_two(nusselt_max(excess, y));
    excess = scale * excess;
    y = scale * y;
    float squared = nusselt_fma(excess, excess, 2.0 * one_plus_ab * y * (excess + y));
    float inverse_squared = 1.0 / (squared > 0.0 ? squared : 1.0);
    float weight_a = excess * (excess + 2.0 * y) * inverse_squared;
    float weight_b = 2.0 * y * nusselt_fma(y, one_plus_ab, excess) * inverse_squared;
    float difference = nusselt_fma(excess, excess, -2.0 * one_plus_ab * y * y) * inverse_squared;
    vec3 v = difference * t.a + weight_b * ab;

    // The point on the arc from c to v, whose cosine with c is uniform.
    vec3 c = self.direction[0];
    vec3 chord = v - c;
    vec3 cv = v + c;
    float depth = 0.5 * dot(chord, chord); // 1 - cosine of the arc
    float room = nusselt_max(0.5 * dot(cv, cv), kNusseltOpposite);
    float tau = sqrt(u.y * nusselt_fma(u.y, room, 2.0 * (1.0 - u.y)) / room);
    float weight_c = (1.0 - tau) + depth * (tau - u.y);
    // Unit up to rounding, except where the arc is almost half a turn.
    vec3 wi = nusselt_fma(-tau, room, nusselt_fma(-u.y, depth, 1.0)) * c + tau * cv;
    wi = inverse_length(wi) * wi;

    // The same weights divided by the distances are barycentric coordinates up to their sum.
    float at_a = nusselt_max(tau * weight_a, 0.0) * t.inverse_a;
    float at_b = nusselt_max(tau * weight_b, 0.0) * t.inverse_b;
    float at_c = nusselt_max(weight_c, 0.0) * self.inverse_distance[0];
    float sum = at_a + at_b + at_c;
    float normalisation = 1.0 / (sum > 0.0 ? sum : 1.0);
    vec3 p = (at_a * normalisation) * t.pa + (at_b * normalisation) * t.pb + (at_c * normalisation) * self.vertex[0];
    // From close by, rounding relative to the size of the light would turn p away from wi.
    float along = dot(p, wi);
    return LightSample(wi, self.inverse_total, self.inverse_scale * (along < 0.125 ? along * wi : p));
}

/// The random numbers for which the sample is wi, a unit direction on the light; (0, 0) at vertex 0.
vec2 polygon_solid_angle_invert(PolygonSolidAngle self, vec3 wi) {
    vec3 c = self.direction[0];
    vec3 n = nusselt_cross(c, wi); // of the great circle through c and wi
    vec3 to_wi = wi - c;
    bool found = self.total <= 0.0;
    vec2 u = vec2(0.0);
    float before = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        // The last triangle also has what rounding moved beyond it.
        if (!found && self.solid_angle[j] > 0.0) {
            vec3 a = self.direction[j + 1];
            vec3 b = self.direction[j + 2];
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
            u.x = before + nusselt_min(partial_angle, self.solid_angle[j]);
            u.y = dot(to_wi, to_wi) / (whole > 0.0 ? whole : 1.0);
            found = to_b > 0.0;
        }
        before = before + self.solid_angle[j];
    }
    return vec2(below_one(u.x / (self.total > 0.0 ? self.total : 1.0)), below_one(u.y));
}

#endif
