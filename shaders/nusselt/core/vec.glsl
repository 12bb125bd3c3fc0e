#ifndef NUSSELT_CORE_VEC_GLSL
#define NUSSELT_CORE_VEC_GLSL
// Follows include/nusselt/core/vec.h @ ac59f87154f2
/// Products that keep full relative precision, and norms without over- and underflow. Twin of
/// include/nusselt/core/vec.h.

#include "../core/real.glsl"

const float kNusseltTiny = 1.262177448353618888e-29; // 2^-96

/// a * b - c * d with an error of at most 2 ulp barring under- and overflow, and never the wrong sign.
float difference_of_products(float a, float b, float c, float d) {
    NUSSELT_PRECISE float cd = c * d;
    float error = two_product_error(c, d, cd);
    NUSSELT_PRECISE float result;
    if (kNusseltFusedFma) {
        result = fma(a, b, -cd) - error;
        return result;
    }
    NUSSELT_PRECISE float ab = a * b;
    result = (ab - cd) + (two_product_error(a, b, ab) - error);
    return result;
}
vec3 difference_of_products(vec3 a, vec3 b, vec3 c, vec3 d) {
    NUSSELT_PRECISE vec3 cd = c * d;
    vec3 error = two_product_error(c, d, cd);
    NUSSELT_PRECISE vec3 result;
    if (kNusseltFusedFma) {
        result = fma(a, b, -cd) - error;
        return result;
    }
    NUSSELT_PRECISE vec3 ab = a * b;
    result = (ab - cd) + (two_product_error(a, b, ab) - error);
    return result;
}

/// Determinant of the matrix with columns a, b; exact sign.
float det(vec2 a, vec2 b) { return difference_of_products(a.x, b.y, a.y, b.x); }

/// Cross product with each component accurate to 2 ulp and of the right sign.
vec3 nusselt_cross(vec3 a, vec3 b) { return difference_of_products(a.yzx, b.zxy, a.zxy, b.yzx); }

/// Largest component by magnitude.
float largest_component(vec3 a) { return nusselt_max(nusselt_max(abs(a.x), abs(a.y)), abs(a.z)); }

/// x, or 0 if it is below 2^-96: next to numbers of order one, products with it would underflow.
float without_tiny(float x) { return abs(x) < kNusseltTiny ? 0.0 : x; }
vec3 without_tiny(vec3 a) { return vec3(without_tiny(a.x), without_tiny(a.y), without_tiny(a.z)); }

/// Euclidean norm without over- or underflow of the squares; 0 for the zero vector.
float nusselt_length(vec3 a) {
    float down = reciprocal_power_of_two(largest_component(a));
    vec3 scaled = down * a;
    return sqrt(dot(scaled, scaled)) * reciprocal_power_of_two(down);
}

/// Reciprocal of the Euclidean norm of a vector of order one or less; 0 where all components are below 2^-96.
float inverse_length(vec3 a) {
    float squared = dot(a, a);
    if (squared > kNusseltTiny) return 1.0 / sqrt(squared);
    float extent = largest_component(a);
    if (!(extent >= kNusseltTiny)) return 0.0;
    float up = reciprocal_power_of_two(extent);
    vec3 scaled = up * a;
    return up / sqrt(dot(scaled, scaled));
}

/// Unit vector, or the zero vector if a is zero; any finite length is fine.
vec3 nusselt_normalize(vec3 a) {
    vec3 scaled = reciprocal_power_of_two(largest_component(a)) * a;
    float squared = dot(scaled, scaled);
    return squared > 0.0 ? (1.0 / sqrt(squared)) * scaled : vec3(0.0);
}

#endif
