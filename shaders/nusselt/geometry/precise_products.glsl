#ifndef NUSSELT_GEOMETRY_PRECISE_PRODUCTS_GLSL
#define NUSSELT_GEOMETRY_PRECISE_PRODUCTS_GLSL
// Follows include/nusselt/geometry/precise_products.h @ 0de86d00f321
/// Sums and products that keep what rounding takes from them, for the sides of polygons. Twin of
/// include/nusselt/geometry/precise_products.h.

#include "../core/vec.glsl"

/// What rounding took from the sum of two vectors.
/// \param sum a + b, rounded.
vec3 two_sum_error(vec3 a, vec3 b, vec3 sum) {
    NUSSELT_PRECISE vec3 added = sum - a;
    NUSSELT_PRECISE vec3 error = (a - (sum - added)) + (b - added);
    return error;
}
/// \copydoc two_sum_error
float two_sum_error(float a, float b, float sum) {
    NUSSELT_PRECISE float added = sum - a;
    NUSSELT_PRECISE float error = (a - (sum - added)) + (b - added);
    return error;
}

/// The triple product det(v, a, b), computed in twice the precision and rounded once.
float precise_triple_product(vec3 v, vec3 a, vec3 b) {
    NUSSELT_PRECISE vec3 left = a.yzx * b.zxy;
    NUSSELT_PRECISE vec3 right = a.zxy * b.yzx;
    NUSSELT_PRECISE vec3 n = left - right;
    vec3 n_error = two_sum_error(left, -right, n) +
                   (two_product_error(a.yzx, b.zxy, left) - two_product_error(a.zxy, b.yzx, right));
    NUSSELT_PRECISE vec3 product = v * n;
    vec3 product_error = two_product_error(v, n, product);
    NUSSELT_PRECISE float xy = product.x + product.y;
    NUSSELT_PRECISE float sum = xy + product.z;
    float sum_error = two_sum_error(product.x, product.y, xy) + two_sum_error(xy, product.z, sum);
    return sum + (sum_error + (product_error.x + product_error.y + product_error.z) + dot(v, n_error));
}

/// What rounding may have taken from a side of a polygon.
/// \param a, b     vertices from and to which the side leads.
/// \param side     a sum of edges.
/// \param lost     what rounding took from the sum.
/// \param rounding bound on what rounding took from the edges, if they are differences of vertices.
/// \returns what b - a exceeds the side by; `lost` if this is too much for edges that are differences of the vertices.
///          The edges then were there first.
vec3 excess_of_side(vec3 a, vec3 b, vec3 side, vec3 lost, vec3 rounding) {
    NUSSELT_PRECISE vec3 difference = b - a;
    NUSSELT_PRECISE vec3 excess = (difference - side) + two_sum_error(b, -a, difference);
    vec3 off = abs(excess - lost);
    return vec3(off.x <= rounding.x ? excess.x : lost.x, off.y <= rounding.y ? excess.y : lost.y,
                off.z <= rounding.z ? excess.z : lost.z);
}

#endif
