#ifndef NUSSELT_GEOMETRY_FAN_VOLUMES_GLSL
#define NUSSELT_GEOMETRY_FAN_VOLUMES_GLSL
// Follows include/nusselt/geometry/fan_volumes.h @ ee99be24acdc
/// Triple products of the triangles of a polygon. Twin of include/nusselt/geometry/fan_volumes.h.

#include "../geometry/convex_polygon.glsl"

/// Six times the volumes between the origin and the triangles of the fan around vertex 0 of a polygon, with the sign of
/// plane_distance().
struct FanVolumes {
    float volume[kNusseltSlots - 2];
    float total;
    bool conclusive; ///< whether refining would change only the last digits
};

FanVolumes fan_volumes(ConvexPolygon polygon) {
    FanVolumes self;
    vec3 v = polygon.vertex[0];
    vec3 offset = polygon.edge[0];
    vec3 normal = vec3(0.0);
    float product_bound = 0.0;
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        vec3 edge = polygon.edge[j + 1];
        vec3 n = kNusseltFusedFma ? nusselt_cross(offset, edge) : cross(offset, edge);
        // Rounding of the built-in cross product is relative to the product of the lengths.
        product_bound = product_bound + dot(offset, offset) * dot(edge, edge);
        self.volume[j] = nusselt_fma(v.z, n.z, nusselt_fma(v.y, n.y, v.x * n.x));
        self.total = self.total + self.volume[j];
        normal = normal + n;
        offset = offset + edge;
    }
    if (kNusseltFusedFma) product_bound = dot(normal, normal);
    // Squares that leave the range of numbers are not conclusive.
    float sine = least_conclusive_sine();
    self.conclusive = self.total * self.total > (sine * sine) * dot(v, v) * product_bound;
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

/// Computes volumes that are not conclusive once more, with products of twice the precision. They are 0 if the plane of
/// the polygon cannot be told from one through the origin.
FanVolumes fan_volumes_refined(const ConvexPolygon polygon) {
    FanVolumes self;
    float distance = rounded_plane_distance(polygon, nearest_vertex(polygon));
    float side = copysign(1.0, distance);
    precise_fan_products(polygon, polygon.vertex[0], self.volume);
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        self.volume[j] = distance == 0.0 ? 0.0 : side * nusselt_max(side * self.volume[j], 0.0);
        self.total = self.total + self.volume[j];
    }
    self.conclusive = true;
    return self;
}

#endif
