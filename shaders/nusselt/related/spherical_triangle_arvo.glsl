#ifndef NUSSELT_RELATED_SPHERICAL_TRIANGLE_ARVO_GLSL
#define NUSSELT_RELATED_SPHERICAL_TRIANGLE_ARVO_GLSL
// Follows include/nusselt/related/spherical_triangle_arvo.h @ 384cb95a8091
/// Uniform sampling of spherical triangles, as published: J. Arvo 1995, Stratified Sampling of Spherical Triangles, SIGGRAPH
/// 95, doi:10.1145/218380.218500. Twin of include/nusselt/related/spherical_triangle_arvo.h.

#include "../related/peters_arithmetic.glsl"

/// A spherical triangle with the vertices a, b and c of the paper. Samples lie on arcs from b to the edge from a to c.
struct SphericalTriangleArvo {
    vec3 a, b;
    vec3 tangent;               ///< at a, towards c
    float cos_alpha, sin_alpha; ///< of the angle at a
    float cos_b, cos_c;         ///< of the lengths of the edges from a to c and to b
    float solid_angle;          ///< 0 for triangles without area
};

/// \param a, b, c unit vectors, in either winding.
SphericalTriangleArvo make_spherical_triangle_arvo(vec3 a, vec3 b, vec3 c) {
    SphericalTriangleArvo self;
    self.a = a;
    self.b = b;
    self.cos_b = dot(a, c);
    self.cos_c = dot(a, b);
    vec3 to_b = peters_cross(a, b);
    vec3 to_c = peters_cross(a, c);
    // The product of to_b with a is zero up to rounding. Without it, small triangles keep more digits.
    float volume = abs(dot(to_b, c - a));
    float squared = dot(to_c, to_c);
    float product = sqrt(dot(to_b, to_b) * squared);
    bool present = product > 0.0;
    float inverse = 1.0 / (present ? product : 1.0);
    self.cos_alpha = inverse * dot(to_b, to_c);
    self.sin_alpha = inverse * volume;
    self.tangent = (1.0 / sqrt(present ? squared : 1.0)) * peters_cross(to_c, a);
    self.solid_angle = 2.0 * peters_atan2_positive(volume, 1.0 + self.cos_c + self.cos_b + dot(b, c));
    return self;
}

/// The direction up to whose arc the triangle has a solid angle.
/// \param part solid angle [sr], from 0 to solid_angle.
/// \param u in [0, 1), moves along the arc.
vec3 spherical_triangle_arvo_direction(const SphericalTriangleArvo self, float part, float u) {
    // Sine and cosine of part - alpha; the solid angle can exceed a half turn.
    SinCos half_part = peters_sincos_half_turn(0.5 * part);
    float sin_part = 2.0 * half_part.sine * half_part.cosine;
    float cos_part = half_part.cosine * half_part.cosine - half_part.sine * half_part.sine;
    float s = sin_part * self.cos_alpha - cos_part * self.sin_alpha;
    float t = cos_part * self.cos_alpha + sin_part * self.sin_alpha;
    float x = t - self.cos_alpha; // u and v of the paper
    float y = s + self.sin_alpha * self.cos_c;
    float quotient = ((y * t - x * s) * self.cos_alpha - y) / ((y * s + x * t) * self.sin_alpha);
    // Rounding must not move the end of the arc away from the edge. Where it leaves 0 / 0, the sample is at a.
    float q = nusselt_max(nusselt_min(quotient, 1.0), self.cos_b);
    vec3 end = q * self.a + sqrt(nusselt_max((1.0 - q) * (1.0 + q), 0.0)) * self.tangent;
    // Along the arc, the cosine of the angle from b is uniform.
    float end_cosine = dot(end, self.b);
    float z = 1.0 - u * (1.0 - end_cosine);
    float rise = sqrt(nusselt_max(u * (1.0 + z) / (1.0 + end_cosine), 0.0));
    return (z - rise * end_cosine) * self.b + rise * end;
}

/// Where a direction is in a triangle.
struct PlaceInTriangle {
    float part;  ///< as in spherical_triangle_arvo_direction(), at most solid_angle
    float u;     ///< likewise; 0 at b
    bool behind; ///< whether the arc from b through the direction leaves the edge to a behind
};

/// \param side 1 or -1, the sign of the triple product of a, b and c.
PlaceInTriangle spherical_triangle_arvo_place_of(const SphericalTriangleArvo self, vec3 wi, float side) {
    // The plane of the arc meets that of the edge from a to c in a direction with these coordinates along a and the tangent.
    // Before a, a itself will do.
    vec3 n = side * peters_cross(wi, self.b);
    float y = -dot(n, self.a);
    bool behind = y > 0.0 && self.solid_angle > 0.0;
    float x = behind ? dot(n, self.tangent) : 1.0;
    float rise = behind ? y : 0.0;
    float inverse = 1.0 / sqrt(x * x + rise * rise);
    vec3 end = (inverse * x) * self.a + (inverse * rise) * self.tangent;

    float volume = inverse * rise * abs(dot(peters_cross(self.a, self.b), self.tangent));
    float cosines = 1.0 + self.cos_c + inverse * x + dot(self.b, end);
    vec3 to_wi = wi - self.b;
    vec3 to_end = end - self.b;
    float squared = dot(to_end, to_end);
    return PlaceInTriangle(nusselt_min(2.0 * peters_atan2_positive(volume, cosines), self.solid_angle),
                           dot(to_wi, to_wi) / (squared > 0.0 ? squared : 1.0), behind);
}

#endif
