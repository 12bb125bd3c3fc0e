#include "visibility/triangle_bvh.h"

#include "scene/model/lights/round/round_axes.h"
#include "visibility/alpha.h"
#include "visibility/embree_builder.h"
#include "visibility/round_surfaces.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace nusselt::visibility {

namespace {

/// This shape is at least as fast as others, see docs/performance.md.
constexpr TreeShape kShape = {.width = 4, .min_leaf_size = 1, .max_leaf_size = 4};

/// The fraction of their size by which boxes of triangles grow. Shaders find the edges of a triangle with rounding
/// errors that are proportional to the distance of its corners from the ray; that of the box from the ray they take
/// into account.
constexpr float kGrowth = 4 * std::numeric_limits<float>::epsilon();

using Corners = std::array<std::array<float, 3>, 3>;

Corners corners_of(const scene::Scene& scene, std::uint32_t triangle) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const scene::Float3& p = scene.positions[scene.triangles[triangle].vertex[i]];
        corners[i] = {p.x, p.y, p.z};
    }
    return corners;
}

Box grown(Box box) {
    float size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) size = std::max(size, box.upper[axis] - box.lower[axis]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] -= kGrowth * size;
        box.upper[axis] += kGrowth * size;
    }
    return box;
}

double area_of(const RTCBounds& b) {
    const double x = double{b.upper_x} - b.lower_x;
    const double y = double{b.upper_y} - b.lower_y;
    const double z = double{b.upper_z} - b.lower_z;
    return x * y + y * z + z * x;
}

RTCBounds to_bounds(const Box& box) {
    return {box.lower[0], box.lower[1], box.lower[2], 0, box.upper[0], box.upper[1], box.upper[2], 0};
}

class Builder {
public:
    explicit Builder(const scene::Scene& scene) : scene_(scene) {}

    TriangleBvh build();

private:
    /// \returns its bounds, empty ones if nothing is left
    Box add_triangles(std::uint32_t first, std::uint32_t count);
    void add_rounds();
    void add_instances(const std::vector<Box>& objects);
    /// \param leaf function from a BuiltLeaf to a link
    /// \returns the bounds
    template <class Leaf>
    Box add_tree(std::vector<RTCBuildPrimitive> primitives, const TreeShape& shape, const Leaf& leaf);
    template <class Leaf>
    void flatten(const BuiltNode& built, const RTCBounds& bounds, const Leaf& leaf);
    std::uint32_t add_leaf(const BuiltLeaf& leaf);

    std::uint32_t node_count() const { return static_cast<std::uint32_t>(bvh_.nodes.size()); }

    const scene::Scene& scene_;
    Device device_ = make_device();
    TriangleBvh bvh_;
};

TriangleBvh Builder::build() {
    if (scene_.triangles.size() > interface::kBvhNumberMask)
        throw std::runtime_error("GPUs support at most 2^30 triangles; this scene has " +
                                 std::to_string(scene_.triangles.size()));
    bvh_.instances.resize(1 + scene_.instances.size());
    std::vector<Box> bounds;
    std::vector<std::uint32_t> ends = {0};
    for (const scene::Object& object : scene_.objects) {
        bounds.push_back(add_triangles(object.first_triangle, object.triangle_count));
        ends.push_back(node_count());
    }
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
        const scene::Instance& instance = scene_.instances[i];
        const auto inverse = inverse_of(instance.world_from_object);
        interface::BvhInstance& target = bvh_.instances[1 + i];
        std::copy(inverse.begin(), inverse.end(), target.object_from_world);
        target.first_node = ends[instance.object];
        target.end_node = ends[instance.object + 1];
    }
    const std::uint32_t first_node = node_count();
    add_triangles(0, static_cast<std::uint32_t>(world_triangle_count(scene_)));
    add_rounds();
    add_instances(bounds);
    bvh_.instances[0] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, first_node, node_count()};
    return std::move(bvh_);
}

Box Builder::add_triangles(std::uint32_t first, std::uint32_t count) {
    std::vector<RTCBuildPrimitive> primitives;
    for (std::uint32_t triangle = first; triangle < first + count; ++triangle) {
        if (presence_of(scene_.materials[scene_.triangle_material[triangle]]) == Presence::none ||
            round_light_of(scene_, triangle) >= 0)
            continue;
        const Corners corners = corners_of(scene_, triangle);
        if (!std::all_of(corners.begin(), corners.end(), is_usable)) continue;
        Box box;
        for (const auto& corner : corners) box.add(corner);
        primitives.push_back(make_primitive(grown(box), triangle));
    }
    return add_tree(std::move(primitives), kShape, [&](const BuiltLeaf& leaf) { return add_leaf(leaf); });
}

void Builder::add_rounds() {
    std::vector<RTCBuildPrimitive> primitives;
    for (const RoundSurface& surface : make_round_surfaces(scene_))
        primitives.push_back(make_primitive(grown({surface.lower, surface.upper}), surface.round_light));
    add_tree(std::move(primitives), {.width = kShape.width},
             [](const BuiltLeaf& leaf) { return interface::kBvhRound | leaf.primitive[0]; });
}

void Builder::add_instances(const std::vector<Box>& objects) {
    std::vector<RTCBuildPrimitive> primitives;
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
        const scene::Instance& instance = scene_.instances[i];
        const Box& object = objects[instance.object];
        if (object.lower[0] > object.upper[0]) continue;
        const Box box = transformed(instance.world_from_object, object);
        if (!is_usable(box.lower) || !is_usable(box.upper)) continue;
        primitives.push_back(make_primitive(box, static_cast<std::uint32_t>(1 + i)));
    }
    add_tree(std::move(primitives), {.width = kShape.width},
             [](const BuiltLeaf& leaf) { return interface::kBvhInstance | leaf.primitive[0]; });
}

template <class Leaf>
Box Builder::add_tree(std::vector<RTCBuildPrimitive> primitives, const TreeShape& shape, const Leaf& leaf) {
    if (primitives.empty()) return {};
    const BuiltTree built(device_.get(), std::move(primitives), shape);
    flatten(built.root(), to_bounds(built.bounds()), leaf);
    return built.bounds();
}

template <class Leaf>
void Builder::flatten(const BuiltNode& built, const RTCBounds& b, const Leaf& leaf) {
    const std::size_t index = bvh_.nodes.size();
    bvh_.nodes.push_back({{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}, 0});
    if (built.is_leaf) {
        bvh_.nodes[index].link = leaf(static_cast<const BuiltLeaf&>(built));
        return;
    }
    const auto& inner = static_cast<const BuiltInner&>(built);
    std::array<std::uint32_t, kLargestTreeWidth> order = {};
    std::iota(order.begin(), order.end(), 0u);
    // Large children are hit most often, and a hit ends the search.
    std::stable_sort(order.begin(), order.begin() + inner.count,
                     [&](auto i, auto j) { return area_of(inner.bounds[i]) > area_of(inner.bounds[j]); });
    for (std::uint32_t i = 0; i < inner.count; ++i)
        flatten(*inner.child[order[i]], inner.bounds[order[i]], leaf);
    bvh_.nodes[index].link = interface::kBvhInner | node_count();
}

std::uint32_t Builder::add_leaf(const BuiltLeaf& leaf) {
    const auto first = static_cast<std::uint32_t>(bvh_.triangles.size());
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
        const std::uint32_t triangle = leaf.primitive[i];
        interface::BvhTriangle& target = bvh_.triangles.emplace_back();
        const Corners corners = corners_of(scene_, triangle);
        for (std::size_t k = 0; k < 9; ++k) target.corner[k] = corners[k / 3][k % 3];
        const scene::Material& material = scene_.materials[scene_.triangle_material[triangle]];
        target.number = triangle | (presence_of(material) == Presence::partial ? interface::kBvhPartial : 0);
    }
    bvh_.triangles.back().number |= interface::kBvhLastOfLeaf;
    return interface::kBvhTriangles | first;
}

} // namespace

TriangleBvh make_triangle_bvh(const scene::Scene& scene) { return Builder(scene).build(); }

} // namespace nusselt::visibility
