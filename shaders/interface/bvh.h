#ifndef NUSSELT_INTERFACE_BVH_H
#define NUSSELT_INTERFACE_BVH_H
/// The hierarchy that shaders trace shadow rays with: storage buffers of these, made by src/visibility/triangle_bvh.h.
///
/// Nodes are stored in depth-first order and each knows where its subtree ends. Traversal is a walk through the array
/// that skips what the ray misses: it needs no stack and is never deeper than one instance.

#ifdef __cplusplus
#include <cstdint>
namespace nusselt::interface {
using uint = std::uint32_t;
#endif

// BvhNode::link has the kind of a child in two bits, and an index in the others.
const uint kBvhKindMask = 3u << 30;
const uint kBvhInner = 0u;           ///< next node where the ray misses the box
const uint kBvhTriangles = 1u << 30; ///< first triangle of a leaf
const uint kBvhInstance = 2u << 30;  ///< an instance
const uint kBvhRound = 3u << 30;     ///< a round light, by its index among them

/// A box in the coordinates of the world or of an object. Where a ray hits it, and after leaves, the next node follows.
struct BvhNode {
    float lower[3];
    float upper[3];
    uint link;
};

// Flags of BvhTriangle::number.
const uint kBvhLastOfLeaf = 1u << 31;
const uint kBvhPartial = 1u << 30; ///< alpha decides whether a ray hits it
const uint kBvhNumberMask = ~(3u << 30);

struct BvhTriangle {
    float corner[9]; ///< x, y, z of the first, second and third vertex [m]
    uint number;     ///< index into Scene::triangles, with flags
};

/// Number 0 is the world, number i + 1 a copy of an object: Scene::instances[i].
struct BvhInstance {
    float object_from_world[12]; ///< rows of four: the linear part, then the translation
    uint first_node;
    uint end_node; ///< behind the last
};

#ifdef __cplusplus
static_assert(sizeof(BvhNode) == 28 && sizeof(BvhTriangle) == 40 && sizeof(BvhInstance) == 56);
} // namespace nusselt::interface
#endif
#endif
