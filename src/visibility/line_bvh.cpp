#include "visibility/line_bvh.h"

#include "visibility/alpha.h"
#include "visibility/embree_device.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace nusselt::visibility {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct BvhDeleter {
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};
using BuiltBvh = std::unique_ptr<RTCBVHTy, BvhDeleter>;

/// What Embree's builder makes, in memory of its own.
struct BuiltNode {
    bool is_leaf;
    std::uint32_t count; ///< of children or primitives
};
struct BuiltInner : BuiltNode {
    const BuiltNode* child[kBvhWidth];
    RTCBounds bounds[kBvhWidth];
};
struct BuiltLeaf : BuiltNode {
    std::uint32_t primitive[kBvhWidth];
};

void* create_inner(RTCThreadLocalAllocator allocator, unsigned count, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltInner), 16)) BuiltInner{{false, count}, {}, {}};
}

void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuiltInner*>(node)->child[i] = static_cast<const BuiltNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) static_cast<BuiltInner*>(node)->bounds[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void*) {
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuiltLeaf), 16))
        BuiltLeaf{{true, static_cast<std::uint32_t>(count)}, {}};
    for (std::size_t i = 0; i < count; ++i) leaf->primitive[i] = primitives[i].primID;
    return leaf;
}

/// \param leaf_size largest number of primitives in a leaf
const BuiltNode* build(RTCDevice device, RTCBVH bvh, std::vector<RTCBuildPrimitive>& primitives,
                       unsigned leaf_size) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.maxBranchingFactor = kBvhWidth;
    arguments.maxDepth = kLargestBvhDepth;
    arguments.sahBlockSize = leaf_size;
    // Nodes with fewer children, but fuller blocks: a block costs the same whether it is full or not.
    arguments.minLeafSize = leaf_size;
    arguments.maxLeafSize = leaf_size;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.capacity();
    arguments.createNode = create_inner;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    const void* root = rtcBuildBVH(&arguments);
    check_for_error(device);
    return static_cast<const BuiltNode*>(root);
}

struct Box {
    std::array<float, 3> lower = {kInfinity, kInfinity, kInfinity};
    std::array<float, 3> upper = {-kInfinity, -kInfinity, -kInfinity};

    void add(const std::array<float, 3>& p) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], p[axis]);
            upper[axis] = std::max(upper[axis], p[axis]);
        }
    }
    void add_bounds(const RTCBuildPrimitive& primitive) {
        add({{primitive.lower_x, primitive.lower_y, primitive.lower_z}});
        add({{primitive.upper_x, primitive.upper_y, primitive.upper_z}});
    }
};

RTCBuildPrimitive make_primitive(const Box& box, std::uint32_t index) {
    return {box.lower[0], box.lower[1], box.lower[2], 0, box.upper[0], box.upper[1], box.upper[2], index};
}

Box bounds_of(const std::vector<RTCBuildPrimitive>& primitives) {
    Box box;
    for (const RTCBuildPrimitive& primitive : primitives) box.add_bounds(primitive);
    return box;
}

using Corners = std::array<std::array<float, 3>, 3>;

Corners corners_of(const scene::Scene& scene, std::uint32_t triangle) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const scene::Float3& p = scene.positions[scene.triangles[triangle].vertex[i]];
        // The sum turns -0 into 0: what is equal has equal bits.
        corners[i] = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Whether Embree's builder can sort the box, and its scenes have it: squares of coordinates must be in the range of float.
bool is_usable(const Box& box) {
    constexpr float kLargest = 1.844e18f;
    const auto is_usable_point = [](const std::array<float, 3>& p) {
        return std::all_of(p.begin(), p.end(), [](float x) { return std::fabs(x) < kLargest; });
    };
    return is_usable_point(box.lower) && is_usable_point(box.upper);
}

/// World space to object space.
std::array<float, 12> inverse_of(const std::array<float, 12>& m) {
    const auto at = [&](std::size_t row, std::size_t column) { return double{m[4 * row + column]}; };
    double inverse[3][3];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
            inverse[i][j] = at(r0, c0) * at(r1, c1) - at(r0, c1) * at(r1, c0);
        }
    const double determinant = at(0, 0) * inverse[0][0] + at(0, 1) * inverse[1][0] + at(0, 2) * inverse[2][0];
    std::array<float, 12> result;
    for (std::size_t i = 0; i < 3; ++i) {
        double translation = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            inverse[i][j] /= determinant;
            translation -= inverse[i][j] * at(j, 3);
            result[4 * i + j] = static_cast<float>(inverse[i][j]);
        }
        result[4 * i + 3] = static_cast<float>(translation);
    }
    return result;
}

/// Rounding errors included: those of instances far from the origin of their object are not those of their box.
/// \param m as Instance::world_from_object
Box transformed(const std::array<float, 12>& m, const Box& box) {
    Box result;
    for (std::size_t row = 0; row < 3; ++row) {
        result.lower[row] = result.upper[row] = m[4 * row + 3];
        float size = std::fabs(m[4 * row + 3]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float a = m[4 * row + axis] * box.lower[axis];
            const float b = m[4 * row + axis] * box.upper[axis];
            result.lower[row] += std::min(a, b);
            result.upper[row] += std::max(a, b);
            size += std::max(std::fabs(a), std::fabs(b));
        }
        const float rounding = 4 * std::numeric_limits<float>::epsilon() * size;
        result.lower[row] -= rounding;
        result.upper[row] += rounding;
    }
    return result;
}

} // namespace

struct LineBvh::State {
    explicit State(const scene::Scene& scene);

    /// What a hierarchy begins with.
    struct Root {
        std::uint32_t reference = kEmptyBvh;
        Box bounds;
        std::uint64_t block_count = 0; ///< with those of instances
    };
    struct Roots {
        Root triangles, instances;
    };

    Roots add_all(const scene::Scene& scene, Presence presence);
    Root add_triangles(const scene::Scene& scene, Presence presence, std::uint32_t first,
                       std::uint32_t count);
    Root add_instances(const scene::Scene& scene, const std::vector<Root>& objects);
    /// \param leaf function from a BuiltLeaf to a reference
    template <class Leaf>
    Root add(std::vector<RTCBuildPrimitive> primitives, unsigned leaf_size, const Leaf& leaf);
    template <class Leaf>
    std::uint32_t flatten(const BuiltNode* built, int depth, const Leaf& leaf);
    std::uint32_t add_block(const scene::Scene& scene, const BuiltLeaf& leaf);

    Device device = make_device();
    std::vector<LineBvhNode> nodes;
    std::vector<TriangleBlock> blocks;
    std::vector<LineBvhInstance> instances;
    Roots full, partial; // after what they are made of
};

LineBvh::State::State(const scene::Scene& scene)
    : full(add_all(scene, Presence::full)), partial(add_all(scene, Presence::partial)) {
    nodes.shrink_to_fit();
    blocks.shrink_to_fit();
    device.reset();
}

LineBvh::State::Roots LineBvh::State::add_all(const scene::Scene& scene, Presence presence) {
    const auto world_count = static_cast<std::uint32_t>(world_triangle_count(scene));
    const Root world = add_triangles(scene, presence, 0, world_count);
    std::vector<Root> objects;
    for (const scene::Object& object : scene.objects)
        objects.push_back(add_triangles(scene, presence, object.first_triangle, object.triangle_count));
    const Root copies = add_instances(scene, objects);
    return {world, copies};
}

LineBvh::State::Root LineBvh::State::add_triangles(const scene::Scene& scene, Presence presence,
                                                   std::uint32_t first, std::uint32_t count) {
    std::vector<RTCBuildPrimitive> primitives;
    for (std::uint32_t triangle = first; triangle < first + count; ++triangle) {
        if (presence_of(scene.materials[scene.triangle_material[triangle]]) != presence) continue;
        Box box;
        for (const auto& corner : corners_of(scene, triangle)) box.add(corner);
        if (is_usable(box)) primitives.push_back(make_primitive(box, triangle));
    }
    const std::size_t blocks_before = blocks.size();
    const auto leaf = [&](const BuiltLeaf& of) { return add_block(scene, of); };
    Root root = add(std::move(primitives), kBvhWidth, leaf);
    root.block_count = blocks.size() - blocks_before;
    return root;
}

LineBvh::State::Root LineBvh::State::add_instances(const scene::Scene& scene,
                                                   const std::vector<Root>& objects) {
    std::vector<RTCBuildPrimitive> primitives;
    std::uint64_t block_count = 0;
    for (const scene::Instance& instance : scene.instances) {
        const Root& object = objects[instance.object];
        if (object.reference == kEmptyBvh) continue;
        const auto& m = instance.world_from_object;
        const Box box = transformed(m, object.bounds);
        if (!is_usable(box)) continue;
        block_count += object.block_count;
        primitives.push_back(make_primitive(box, static_cast<std::uint32_t>(instances.size())));
        LineBvhInstance& target = instances.emplace_back();
        for (std::size_t i = 0; i < 9; ++i) target.world_from_object[i] = m[4 * (i / 3) + i % 3];
        const auto inverse = inverse_of(m);
        std::copy(inverse.begin(), inverse.end(), target.object_from_world);
        target.triangles = object.reference;
    }
    const auto leaf = [](const BuiltLeaf& of) { return kBvhInstance | of.primitive[0]; };
    Root root = add(std::move(primitives), 1, leaf);
    root.block_count = block_count;
    return root;
}

template <class Leaf>
LineBvh::State::Root LineBvh::State::add(std::vector<RTCBuildPrimitive> primitives, unsigned leaf_size,
                                         const Leaf& leaf) {
    if (primitives.empty()) return {};
    const Box bounds = bounds_of(primitives);
    const BuiltBvh bvh(rtcNewBVH(device.get()));
    check_for_error(device.get());
    const BuiltNode* built = build(device.get(), bvh.get(), primitives, leaf_size);
    // Large scenes need the memory for what follows.
    primitives = {};
    return {flatten(built, 0, leaf), bounds, 0};
}

template <class Leaf>
std::uint32_t LineBvh::State::flatten(const BuiltNode* built, int depth, const Leaf& leaf) {
    if (built->is_leaf) return leaf(static_cast<const BuiltLeaf&>(*built));
    assert(depth < kLargestBvhDepth && "the builder fails instead");
    const auto& inner = static_cast<const BuiltInner&>(*built);
    const auto index = static_cast<std::uint32_t>(nodes.size());
    LineBvhNode& node = nodes.emplace_back();
    for (std::size_t i = 0; i < kBvhWidth; ++i) {
        const bool exists = i < inner.count;
        const RTCBounds& b = inner.bounds[i];
        const float bounds[6] = {b.lower_x, b.lower_y, b.lower_z, b.upper_x, b.upper_y, b.upper_z};
        for (std::size_t row = 0; row < 6; ++row)
            node.bounds[row][i] = exists ? bounds[row] : (row < 3 ? kInfinity : -kInfinity);
        node.child[i] = kEmptyBvh;
    }
    for (std::size_t i = 0; i < inner.count; ++i)
        nodes[index].child[i] = flatten(inner.child[i], depth + 1, leaf);
    return kBvhNode | index;
}

std::uint32_t LineBvh::State::add_block(const scene::Scene& scene, const BuiltLeaf& leaf) {
    const auto index = static_cast<std::uint32_t>(blocks.size());
    TriangleBlock& block = blocks.emplace_back();
    const float* anywhere = &scene.positions[scene.triangles[leaf.primitive[0]].vertex[0]].x;
    for (std::size_t i = 0; i < kBvhWidth; ++i) {
        const bool exists = i < leaf.count;
        block.light[i] = exists ? scene.triangle_light[leaf.primitive[i]] : kNoTriangle;
        const Corners corners = exists ? corners_of(scene, leaf.primitive[i]) : Corners{};
        for (std::size_t row = 0; row < 9; ++row)
            block.corner[row][i] = exists ? corners[row / 3][row % 3] : anywhere[row % 3];
    }
    return kBvhBlock | index;
}

LineBvh::LineBvh(const scene::Scene& scene) : state_(std::make_unique<State>(scene)) {}

LineBvh::~LineBvh() = default;
LineBvh::LineBvh(LineBvh&&) noexcept = default;
LineBvh& LineBvh::operator=(LineBvh&&) noexcept = default;

LineBvhView LineBvh::view() const {
    const auto references = [](const State::Roots& roots) {
        return LineBvhRoots{roots.triangles.reference, roots.instances.reference};
    };
    const State::Roots& full = state_->full;
    return {state_->nodes.data(),        state_->blocks.data(),
            state_->instances.data(),    references(full),
            references(state_->partial), full.triangles.block_count + full.instances.block_count};
}

} // namespace nusselt::visibility
