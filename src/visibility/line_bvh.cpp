#include "visibility/line_bvh.h"

#include "visibility/alpha.h"
#include "visibility/embree_builder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>
#include <vector>

namespace nusselt::visibility {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

static_assert(kBvhWidth <= int{kLargestTreeWidth} && kBvhWidth <= int{kLargestLeafSize});

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

} // namespace

struct LineBvh::State {
    explicit State(const scene::Scene& scene);

    /// The start of a hierarchy.
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
        const Corners corners = corners_of(scene, triangle);
        if (!std::all_of(corners.begin(), corners.end(), is_usable)) continue;
        Box box;
        for (const auto& corner : corners) box.add(corner);
        primitives.push_back(make_primitive(box, triangle));
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
        if (!is_usable(box.lower) || !is_usable(box.upper)) continue;
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
    const BuiltTree built(
        device.get(), std::move(primitives),
        {.width = kBvhWidth,
         .depth = kLargestBvhDepth,
         // Nodes with fewer children, but fuller blocks: a block costs the same whether it is full or
         // not.
         .min_leaf_size = leaf_size,
         .max_leaf_size = leaf_size,
         .block_size = leaf_size});
    return {flatten(&built.root(), 0, leaf), built.bounds(), 0};
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
