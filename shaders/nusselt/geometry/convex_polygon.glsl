#ifndef NUSSELT_GEOMETRY_CONVEX_POLYGON_GLSL
#define NUSSELT_GEOMETRY_CONVEX_POLYGON_GLSL
// Follows include/nusselt/geometry/convex_polygon.h @ 5bdb6a282497
/// Convex planar polygons. Twin of include/nusselt/geometry/convex_polygon.h.

#include "../core/frame.glsl"
#include "../geometry/precise_products.glsl"

/// Clipping adds at most one vertex.
const int kNusseltSlots = NUSSELT_MAX_VERTICES + 1;

/// A convex, planar polygon of 3 to NUSSELT_MAX_VERTICES vertices in either winding, or one more after clipping.
///
/// Edges and the normal are properties of the light: they are stored and rotated, never recomputed from vertices after
/// a shading point was subtracted, which would lose small lights far away.
///
/// Unused slots repeat the last vertex, with edges of length zero between the copies; the last edge always closes the
/// polygon. So a light has zero as its edge number NUSSELT_MAX_VERTICES - 1.
struct ConvexPolygon {
    vec3 vertex[kNusseltSlots]; ///< positions [m]
    vec3 edge[kNusseltSlots];   ///< edge[j] leads from vertex j to its successor in cyclic order [m]
    vec3 normal;                ///< unit normal, right-handed with the winding; zero if the polygon has no area
};

/// Twice the area times the right-handed unit normal; zero if the area cannot be distinguished from rounding.
vec3 doubled_area_normal(ConvexPolygon polygon) {
    NUSSELT_PRECISE vec3 offset = polygon.edge[0];
    NUSSELT_PRECISE vec3 lost = vec3(0.0); // from the offset by rounding: it would give edges on one line an area
    vec3 sum = vec3(0.0);
    float bound = 0.0;
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots - 1; ++j) {
        vec3 edge = polygon.edge[j];
        sum = sum + (nusselt_cross(offset, edge) + nusselt_cross(lost, edge));
        bound = bound + (abs(offset.x) + abs(offset.y) + abs(offset.z)) * (abs(edge.x) + abs(edge.y) + abs(edge.z));
        NUSSELT_PRECISE vec3 next = offset + edge;
        NUSSELT_PRECISE vec3 added = next - offset;
        lost = lost + ((offset - (next - added)) + (edge - added));
        offset = next;
    }
    bool present = largest_component(sum) > (8.0 * kNusseltEpsilon * kNusseltEpsilon) * bound;
    return present ? sum : vec3(0.0);
}

/// Least sine of the angle between the plane of a polygon and the direction to a vertex for which rounding can be ignored:
/// it magnifies rounding errors by the reciprocal. Products that are rounded together with their sum allow twice as much.
float least_conclusive_sine() { return kNusseltFusedFma ? 1.0 / 256.0 : 1.0 / 128.0; }

/// The vertex whose product with the normal has the smallest rounding error, none if it is the origin.
vec3 nearest_vertex(ConvexPolygon polygon) {
    vec3 nearest = polygon.vertex[0];
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots; ++j) {
        vec3 v = polygon.vertex[j];
        nearest = largest_component(v) < largest_component(nearest) ? v : nearest;
    }
    return nearest;
}

/// The distance of the plane that the rounded normal describes; 0 if it cannot be distinguished from rounding.
float rounded_plane_distance(const ConvexPolygon polygon, vec3 nearest) {
    vec3 product = polygon.normal * nearest;
    float distance = product.x + product.y + product.z;
    float rounding = (4.0 * kNusseltEpsilon) * (abs(product.x) + abs(product.y) + abs(product.z));
    return abs(distance) > rounding ? distance : 0.0;
}

/// For each triangle of the fan around vertex 0 the triple product of v and two of its sides, in the order of the
/// winding, with an error as of a single rounding. The C++ text explains how edges and vertices complement each other.
void precise_fan_products(ConvexPolygon polygon, vec3 v, out float product[kNusseltSlots - 2]) {
    NUSSELT_PRECISE vec3 offset = polygon.edge[0]; // from vertex 0 to vertex j + 1
    vec3 lost = vec3(0.0);
    vec3 rounding = (0.5 * kNusseltEpsilon) * abs(offset);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        vec3 a = polygon.vertex[j + 1];
        vec3 edge = polygon.edge[j + 1];
        vec3 edge_rounding = (0.5 * kNusseltEpsilon) * abs(edge);
        vec3 offset_excess = excess_of_side(polygon.vertex[0], a, offset, lost, rounding);
        vec3 edge_excess = excess_of_side(a, polygon.vertex[j + 2], edge, vec3(0.0), edge_rounding);
        product[j] = precise_triple_product(v, offset, edge) +
                     (dot(v, cross(offset_excess, edge)) + dot(v, cross(offset, edge_excess)));
        NUSSELT_PRECISE vec3 next = offset + edge;
        lost = lost + two_sum_error(offset, edge, next);
        rounding = rounding + edge_rounding;
        offset = next;
    }
}

/// The distance of the plane through a vertex, from the vertices and edges instead of the rounded normal.
/// \param rounded distance, for lights whose areas leave the range of numbers.
float precise_plane_distance(const ConvexPolygon polygon, vec3 vertex, float rounded) {
    float product[kNusseltSlots - 2];
    precise_fan_products(polygon, vertex, product);
    float sum = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) sum = sum + product[j];
    vec3 normal = doubled_area_normal(polygon);
    float squared = dot(normal, normal);
    return squared > kNusseltTiny && squared < 1.0 / kNusseltTiny ? sum / sqrt(squared) : rounded;
}

/// Signed distance of the origin from the plane of the polygon [m], positive if the normal points away from it; 0 if
/// it cannot be distinguished from rounding.
float plane_distance(const ConvexPolygon polygon) {
    vec3 nearest = nearest_vertex(polygon);
    float distance = rounded_plane_distance(polygon, nearest);
    if (distance != 0.0 && abs(distance) < least_conclusive_sine() * largest_component(nearest))
        distance = precise_plane_distance(polygon, nearest, distance);
    return distance;
}

/// The largest distance of a vertex from the plane of a polygon [m].
/// \param distance of that plane from the origin.
float warp_of(ConvexPolygon polygon, float distance) {
    float largest = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j)
        largest = nusselt_max(largest, abs(dot(polygon.normal, polygon.vertex[j]) - distance));
    return largest;
}

/// The polygon with the given vertices [m].
/// \param vertices convex and coplanar, in either winding; repeated and collinear vertices are fine.
/// \param count    how many of them there are, 3 to NUSSELT_MAX_VERTICES.
ConvexPolygon make_polygon(vec3 vertices[NUSSELT_MAX_VERTICES], int count) {
    ConvexPolygon polygon;
    vec3 last = vertices[0];
    NUSSELT_UNROLL for (int j = 0; j < NUSSELT_MAX_VERTICES; ++j) {
        last = j < count ? vertices[j] : last;
        polygon.vertex[j] = last;
    }
    polygon.vertex[kNusseltSlots - 1] = last;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j)
        polygon.edge[j] = polygon.vertex[j + 1 < kNusseltSlots ? j + 1 : 0] - polygon.vertex[j];
    polygon.normal = nusselt_normalize(doubled_area_normal(polygon));
    return polygon;
}

/// The polygon that a C++ ConvexPolygon<float, NUSSELT_MAX_VERTICES> holds: the slot for clipping repeats the last
/// vertex.
/// \param vertices positions [m], the last one repeated in unused slots.
/// \param edges    to the successors [m]; the last one closes the polygon.
/// \param normal   unit normal.
ConvexPolygon make_polygon(vec3 vertices[NUSSELT_MAX_VERTICES], vec3 edges[NUSSELT_MAX_VERTICES],
                           vec3 normal) {
    const int n = NUSSELT_MAX_VERTICES;
    ConvexPolygon polygon;
    NUSSELT_UNROLL for (int j = 0; j < n; ++j) {
        polygon.vertex[j] = vertices[j];
        polygon.edge[j] = edges[j];
    }
    polygon.vertex[n] = vertices[n - 1];
    polygon.edge[n - 1] = vec3(0.0);
    polygon.edge[n] = edges[n - 1];
    polygon.normal = normal;
    return polygon;
}

/// The polygon seen from a shading point: the point becomes the origin, the normal of the frame +z.
ConvexPolygon to_shading_space(ConvexPolygon world, vec3 point, const Frame frame) {
    ConvexPolygon local;
    local.vertex[0] = frame_to_local(frame, world.vertex[0] - point);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        local.edge[j] = frame_to_local(frame, world.edge[j]);
        if (j + 1 < kNusseltSlots) local.vertex[j + 1] = local.vertex[j] + local.edge[j];
    }
    local.normal = frame_to_local(frame, world.normal);
    return local;
}

#endif
