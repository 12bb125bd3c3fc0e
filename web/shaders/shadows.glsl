#ifndef PAGE_SHADOWS_GLSL
#define PAGE_SHADOWS_GLSL
/// Shadow rays through a hierarchy of boxes in a texture.

#include "surface.glsl"

/// Two texels for each node, in depth-first order: the lower corner and the node that follows when a ray misses the
/// box; the upper corner and, for leaves, the first triangle times 2^kCountBits plus their number, for others -1.
uniform highp sampler2D nodes;
uniform int node_count;

const int kCountBits = @count_bits@;
/// Occluders count up to this fraction of the distance to the light.
const float kShadowEnd = 0.9999;
/// More than the rounding errors of the box test.
const float kBoxSlack = 1.0 + 16.0 * kNusseltEpsilon;

bool hits_triangle(vec3 origin, vec3 direction, int number) {
    vec3 a = triangle_corner(number, 0).xyz;
    vec3 e1 = triangle_corner(number, 1).xyz - a;
    vec3 e2 = triangle_corner(number, 2).xyz - a;
    vec3 across = cross(direction, e2);
    float inverse = 1.0 / dot(e1, across);
    vec3 from_a = origin - a;
    float u = dot(from_a, across) * inverse;
    vec3 q = cross(from_a, e1);
    float v = dot(direction, q) * inverse;
    float t = dot(e2, q) * inverse;
    // NaN and infinity, of triangles seen edge-on, fail.
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < kShadowEnd;
}

/// Whether a surface lies between origin and origin + direction.
bool is_occluded(vec3 origin, vec3 direction) {
    // Rays parallel to the sides of boxes become steeper than single precision can tell.
    const vec3 steepest = vec3(1e-18);
    vec3 inverse = 1.0 / mix(direction, mix(steepest, -steepest, vec3(lessThan(direction, vec3(0.0)))),
                             vec3(lessThan(abs(direction), steepest)));
    int node = 0;
    bool hits = false;
    while (node < node_count && !hits) {
        vec4 lower = texel(nodes, 2 * node);
        vec4 upper = texel(nodes, 2 * node + 1);
        vec3 a = (lower.xyz - origin) * inverse;
        vec3 b = (upper.xyz - origin) * inverse;
        vec3 low = min(a, b);
        vec3 high = max(a, b);
        float enter = max(max(low.x, low.y), max(low.z, 0.0));
        float leave = min(min(high.x, high.y), min(high.z, kShadowEnd));
        if (enter <= leave * kBoxSlack) {
            int leaf = int(upper.w);
            int first = leaf >> kCountBits;
            int end = leaf < 0 ? first : first + (leaf & ((1 << kCountBits) - 1));
            for (int i = first; i < end && !hits; ++i) hits = hits_triangle(origin, direction, i);
            ++node;
        } else {
            node = int(lower.w);
        }
    }
    return hits;
}

/// Whether a surface sees a point of a light.
/// \param p relative to the position, in shading space.
bool is_visible(Surface surface, vec3 p) {
    vec3 to_light = frame_to_world(surface.shading, p);
    if (!(dot(surface.normal, to_light) > 0.0)) return false;
    vec3 offset = surface.offset * surface.normal;
    return !traces_shadows() || !is_occluded(surface.position + offset, to_light - offset);
}

#endif
