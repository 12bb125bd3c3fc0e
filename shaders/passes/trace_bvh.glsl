#ifndef NUSSELT_PASSES_TRACE_BVH_GLSL
#define NUSSELT_PASSES_TRACE_BVH_GLSL
/// Traces shadow rays in the hierarchy of src/visibility/triangle_bvh.h. A shader that includes this file must declare
/// before (interface/bvh.h has the structs):
///
///     buffers with arrays `BvhNode bvh_nodes[]`, `BvhTriangle bvh_triangles[]`, `BvhInstance bvh_instances[]`;
///     constants `bool kHasInstances`, `bool kHasPartial` and `bool kHasRounds`: whether the scene has such surfaces;
///     `float alpha_at(uint triangle, vec2 barycentrics, uint instance)`: alpha of Scene::triangles[triangle] at
///     v0 + x (v1 - v0) + y (v2 - v0), as part of Scene::instances[instance] or with ~0u for those of the world;
///     what rounds/round_shadows.glsl needs.

#include "interface/bvh.h"
#include "passes/rounds/round_shadows.glsl"
#include "passes/shadow_ray.glsl"

/// A ray in the coordinates of the world or of an object.
struct BvhRay {
    vec3 origin;
    float t_far;     ///< in units of the scaled direction
    vec3 inverse;    ///< of the scaled direction, no component infinite
    vec3 x_axis;     ///< with y_axis and z_axis: to coordinates in which the ray is the z-axis, z being t
    vec3 y_axis;
    vec3 z_axis;
};

/// \param direction is scaled by a power of two, such that its largest component is near 1: what follows is then independent
///        of units.
BvhRay bvh_ray(vec3 origin, vec3 direction, float t_far) {
    vec3 size = abs(direction);
    float largest = largest_component(direction);
    float scale = reciprocal_power_of_two(largest);
    vec3 d = scale * direction;
    BvhRay ray;
    ray.origin = origin;
    ray.t_far = t_far * reciprocal_power_of_two(scale);
    // Rays parallel to the sides of boxes become steeper than single precision can tell.
    vec3 steepest = vec3(1e-18);
    ray.inverse = 1.0 / mix(d, mix(steepest, -steepest, lessThan(d, vec3(0.0))), lessThan(abs(d), steepest));
    // The shear of S. Woop, C. Benthin, I. Wald 2013, Watertight Ray/Triangle Intersection, JCGT 2(1), without sorting axes.
    float inverse_z;
    if (size.x == largest) {
        inverse_z = 1.0 / d.x;
        ray.x_axis = vec3(-d.y * inverse_z, 1.0, 0.0);
        ray.y_axis = vec3(-d.z * inverse_z, 0.0, 1.0);
        ray.z_axis = vec3(inverse_z, 0.0, 0.0);
    } else if (size.y == largest) {
        inverse_z = 1.0 / d.y;
        ray.x_axis = vec3(1.0, -d.x * inverse_z, 0.0);
        ray.y_axis = vec3(0.0, -d.z * inverse_z, 1.0);
        ray.z_axis = vec3(0.0, inverse_z, 0.0);
    } else {
        inverse_z = 1.0 / d.z;
        ray.x_axis = vec3(1.0, 0.0, -d.x * inverse_z);
        ray.y_axis = vec3(0.0, 1.0, -d.y * inverse_z);
        ray.z_axis = vec3(0.0, 0.0, inverse_z);
    }
    return ray;
}

/// More than the rounding errors of the box test and of shearing, relative to the distance; division may err by 2.5 ulp.
const float kBvhSlack = 1.0 + 16.0 * kNusseltEpsilon;

bool hits_box(const BvhRay ray, const BvhNode node) {
    vec3 a = (vec3(node.lower[0], node.lower[1], node.lower[2]) - ray.origin) * ray.inverse;
    vec3 b = (vec3(node.upper[0], node.upper[1], node.upper[2]) - ray.origin) * ray.inverse;
    vec3 low = min(a, b);
    vec3 high = max(a, b);
    float enter = max(max(low.x, low.y), max(low.z, 0.0));
    float leave = min(min(high.x, high.y), min(high.z, ray.t_far));
    return enter <= leave * kBvhSlack;
}

/// A corner relative to the origin, in coordinates in which the ray is the z-axis: the same for all triangles that share
/// the corner.
vec3 sheared(const BvhRay ray, vec3 corner) {
    precise vec3 p = corner - ray.origin;
    precise vec3 q = vec3(ray.x_axis.x * p.x + ray.x_axis.y * p.y + ray.x_axis.z * p.z,
                          ray.y_axis.x * p.x + ray.y_axis.y * p.y + ray.y_axis.z * p.z,
                          ray.z_axis.x * p.x + ray.z_axis.y * p.y + ray.z_axis.z * p.z);
    return q;
}

/// On which side of the edge from a to b the ray passes. A difference of two rounded products never has the wrong sign, but
/// may vanish; with the corners swapped it is exactly the negative.
float edge_side(vec3 a, vec3 b) {
    precise float side = b.x * a.y - b.y * a.x;
    return side;
}

/// \param barycentrics weights of the second and third corner; only for hits
bool hits_triangle(const BvhRay ray, const BvhTriangle triangle, out vec2 barycentrics) {
    vec3 a = sheared(ray, vec3(triangle.corner[0], triangle.corner[1], triangle.corner[2]));
    vec3 b = sheared(ray, vec3(triangle.corner[3], triangle.corner[4], triangle.corner[5]));
    vec3 c = sheared(ray, vec3(triangle.corner[6], triangle.corner[7], triangle.corner[8]));
    vec3 weights = vec3(edge_side(b, c), edge_side(c, a), edge_side(a, b));
    float least = min(weights.x, min(weights.y, weights.z));
    float most = max(weights.x, max(weights.y, weights.z));
    // Edges belong to both triangles, so that no ray passes between neighbours.
    if (least < 0.0 && most > 0.0) return false;
    float sum = weights.x + weights.y + weights.z;
    if (sum == 0.0) return false;
    weights *= 1.0 / sum;
    barycentrics = weights.yz;
    float t = weights.x * a.z + weights.y * b.z + weights.z * c.z;
    return t > 0.0 && t < ray.t_far;
}

/// \param number of an instance, 0 is the world
BvhRay ray_in_space(const ShadowRay ray, uint number) {
    if (number == 0u) return bvh_ray(ray.origin, ray.direction, ray.t_far);
    float m[12] = bvh_instances[number].object_from_world;
    mat3 linear = mat3(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]);
    return bvh_ray(linear * ray.origin + vec3(m[3], m[7], m[11]), linear * ray.direction, ray.t_far);
}

/// Finds the next leaf whose box the ray hits. Lanes of a group wait for each other there, and then test triangles
/// together.
/// \param node where to begin; afterwards the node that follows the leaf
/// \returns the link of the leaf, kBvhInner if none follows
uint next_leaf(const BvhRay ray, inout uint node, uint end) {
    uint leaf = kBvhInner;
    while (node < end && leaf == kBvhInner) {
        uint link = bvh_nodes[node].link;
        bool is_inner = (link & kBvhKindMask) == kBvhInner;
        bool hits = hits_box(ray, bvh_nodes[node]);
        if (hits && !is_inner) leaf = link;
        node = is_inner && !hits ? link : node + 1u;
    }
    return leaf;
}

// The loops below end by flags: drivers that turn returns into flags would guard all code that follows with them, which
// costs a quarter of the rays per second.

/// \param local the ray where the leaf is
/// \param index first triangle of a leaf
bool hits_leaf(const ShadowRay ray, const BvhRay local, uint index, uint instance) {
    bool hits = false;
    uint number;
    do {
        number = bvh_triangles[index].number;
        vec2 barycentrics;
        if (hits_triangle(local, bvh_triangles[index], barycentrics)) {
            uint triangle = number & kBvhNumberMask;
            hits = !kHasPartial || (number & kBvhPartial) == 0u ||
                   meets_surface(ray, triangle, instance, alpha_at(triangle, barycentrics, instance));
        }
        ++index;
    } while (!hits && (number & kBvhLastOfLeaf) == 0u);
    return hits;
}

/// Whether a surface lies between the origin and origin + t_far * direction, both ends excluded. Rays with NaN,
/// coordinates beyond 1e18, a direction of zero or a negative t_far count as blocked.
bool occluded(vec3 origin, vec3 direction, float t_far) {
    ShadowRay ray = ShadowRay(origin, direction, t_far);
    if (!is_valid(ray)) return true;
    uint space = 0u; // number of an instance
    uint node = bvh_instances[0].first_node;
    uint node_of_world = node; // where the traversal continues after an instance
    for (;;) {
        BvhRay local = ray_in_space(ray, space);
        uint end = bvh_instances[space].end_node;
        uint leaf;
        bool hits = false;
        do {
            leaf = next_leaf(local, node, end);
            uint kind = leaf & kBvhKindMask;
            uint index = leaf & ~kBvhKindMask;
            if (kind == kBvhTriangles)
                hits = hits_leaf(ray, local, index, space - 1u);
            else if (kHasRounds && kind == kBvhRound)
                hits = hits_round(ray, index);
            else
                break;
        } while (!hits);
        if (hits) return true;
        if (kHasInstances && leaf != kBvhInner) {
            node_of_world = node;
            space = leaf & ~kBvhKindMask;
            node = bvh_instances[space].first_node;
        } else {
            if (!kHasInstances || space == 0u) return false;
            space = 0u;
            node = node_of_world;
        }
    }
}

#endif
