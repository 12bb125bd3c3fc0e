#ifndef NUSSELT_GEOMETRY_FAN_VOLUMES_GLSL
#define NUSSELT_GEOMETRY_FAN_VOLUMES_GLSL
// Follows include/nusselt/geometry/fan_volumes.h @ 0f07a15af712
/// Triple products of the triangles of a polygon. Twin of include/nusselt/geometry/fan_volumes.h.

#include "../geometry/convex_polygon.glsl"

#if NUSSELT_FUSED_FMA
const float kNusseltConclusive = 1.0 / 256.0;
#else
const float kNusseltConclusive = 1.0 / 128.0;
#endif

/// Six times the volumes between the origin and the triangles of the fan around vertex 0 of a polygon, with the sign of
/// plane_distance().
struct FanVolumes {
    float volume[kNusseltSlots - 2];
    float total;
    bool conclusive; ///< whether refining would change only the last digits
};

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

FanVolumes fan_volumes(ConvexPolygon polygon) {
    FanVolumes self;
    vec3 v = polygon.vertex[0];
    vec3 offset = polygon.edge[0];
    vec3 normal = vec3(0.0);
    float sturdy = 0.0;
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        vec3 edge = polygon.edge[j + 1];
#if NUSSELT_FUSED_FMA
        vec3 n = nusselt_cross(offset, edge);
#else
        vec3 n = cross(offset, edge);
        sturdy = sturdy + dot(offset, offset) * dot(edge, edge);
#endif
        self.volume[j] = nusselt_fma(v.z, n.z, nusselt_fma(v.y, n.y, v.x * n.x));
        self.total = self.total + self.volume[j];
        normal = normal + n;
        offset = offset + edge;
    }
#if NUSSELT_FUSED_FMA
    sturdy = dot(normal, normal);
#endif
    // Squares that underflow are not conclusive.
    self.conclusive = self.total * self.total > (kNusseltConclusive * kNusseltConclusive) * dot(v, v) * sturdy;
    return self;
}

/// For a polygon whose plane has a known distance.
FanVolumes fan_volumes(ConvexPolygon polygon, float distance) {
    FanVolumes self;
    vec3 offset = polygon.edge[0];
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        self.volume[j] = distance * abs(dot(polygon.normal, nusselt_cross(offset, polygon.edge[j + 1])));
        self.total = self.total + self.volume[j];
        offset = offset + polygon.edge[j + 1];
    }
    self.conclusive = true;
    return self;
}

/// Computes volumes that are not conclusive once more, with products of twice the precision.
FanVolumes fan_volumes_refined(ConvexPolygon polygon) {
    FanVolumes self;
    float distance = plane_distance(polygon);
    float side = copysign(1.0, distance);
    vec3 v = polygon.vertex[0];
    NUSSELT_PRECISE vec3 offset = polygon.edge[0]; // to vertex j + 1
    vec3 lost = vec3(0.0);
    vec3 rounding = (0.5 * kNusseltEpsilon) * abs(offset);
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        vec3 a = polygon.vertex[j + 1];
        vec3 edge = polygon.edge[j + 1];
        vec3 edge_rounding = (0.5 * kNusseltEpsilon) * abs(edge);
        vec3 edge_excess = excess_of_side(a, polygon.vertex[j + 2], edge, vec3(0.0), edge_rounding);
        float exact =
            precise_triple_product(v, offset, edge) +
            (dot(v, cross(excess_of_side(v, a, offset, lost, rounding), edge)) + dot(v, cross(offset, edge_excess)));
        self.volume[j] = distance == 0.0 ? 0.0 : side * nusselt_max(side * exact, 0.0);
        self.total = self.total + self.volume[j];
        NUSSELT_PRECISE vec3 next = offset + edge;
        lost = lost + two_sum_error(offset, edge, next);
        rounding = rounding + edge_rounding;
        offset = next;
    }
    self.conclusive = true;
    return self;
}

#endif
