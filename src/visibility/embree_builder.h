#pragma once
/// Trees over boxes by Embree's builder. Only for code that makes hierarchies of its own from them.

#include "scene/model/scene.h"
#include "visibility/embree_device.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace nusselt::visibility {

struct Box {
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();

    std::array<float, 3> lower = {kInfinity, kInfinity, kInfinity};
    std::array<float, 3> upper = {-kInfinity, -kInfinity, -kInfinity};

    void add(const std::array<float, 3>& p);
};

/// Whether Embree's scenes have triangles with this corner, and its builder can sort boxes with it: squares of coordinates
/// must be in the range of float.
bool is_usable(const std::array<float, 3>& p);

/// The box of an instance, with the rounding errors of transforming points and rays: those of instances far from the origin
/// of their object are not those of their box.
/// \param m as Instance::world_from_object
Box transformed(const std::array<float, 12>& m, const Box& box);

/// World space to object space. \param m as Instance::world_from_object
std::array<float, 12> inverse_of(const std::array<float, 12>& m);

/// Limits for all trees.
inline constexpr unsigned kLargestTreeWidth = 8;
inline constexpr unsigned kLargestLeafSize = 8;

struct TreeShape {
    unsigned width = 2;         ///< largest number of children, at most kLargestTreeWidth
    unsigned depth = 40;        ///< largest number of nodes on the way to a leaf
    unsigned min_leaf_size = 1; ///< nodes with at most this many primitives are not split
    unsigned max_leaf_size = 1; ///< at most kLargestLeafSize
    unsigned block_size = 1;    ///< primitives that cost as much as one
};

/// The tree of the builder, in its own memory.
struct BuiltNode {
    bool is_leaf;
    std::uint32_t count; ///< of children or primitives
};
struct BuiltInner : BuiltNode {
    const BuiltNode* child[kLargestTreeWidth];
    RTCBounds bounds[kLargestTreeWidth];
};
struct BuiltLeaf : BuiltNode {
    std::uint32_t primitive[kLargestLeafSize];
};

class BuiltTree {
public:
    /// Builds a tree with the threads of the caller's oneTBB arena.
    /// \throws std::runtime_error for a lack of memory, a tree deeper than allowed and what else Embree reports
    /// \param primitives boxes with their numbers, usable ones, at least one; freed
    BuiltTree(RTCDevice device, std::vector<RTCBuildPrimitive> primitives, const TreeShape& shape);

    const BuiltNode& root() const { return *root_; }
    const Box& bounds() const { return bounds_; }

private:
    struct BvhDeleter {
        void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
    };
    Box bounds_;
    std::unique_ptr<RTCBVHTy, BvhDeleter> bvh_;
    const BuiltNode* root_ = nullptr;
};

RTCBuildPrimitive make_primitive(const Box& box, std::uint32_t number);

} // namespace nusselt::visibility
