#include "visibility/embree_builder.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace nusselt::visibility {

namespace {

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

Box bounds_of(const std::vector<RTCBuildPrimitive>& primitives) {
    Box box;
    for (const RTCBuildPrimitive& primitive : primitives) {
        box.add({primitive.lower_x, primitive.lower_y, primitive.lower_z});
        box.add({primitive.upper_x, primitive.upper_y, primitive.upper_z});
    }
    return box;
}

const BuiltNode* build(RTCBVH bvh, std::vector<RTCBuildPrimitive>& primitives, const TreeShape& shape) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.maxBranchingFactor = shape.width;
    arguments.maxDepth = shape.depth;
    arguments.sahBlockSize = shape.block_size;
    arguments.minLeafSize = shape.min_leaf_size;
    arguments.maxLeafSize = shape.max_leaf_size;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.capacity();
    arguments.createNode = create_inner;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    return static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
}

} // namespace

void Box::add(const std::array<float, 3>& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], p[axis]);
        upper[axis] = std::max(upper[axis], p[axis]);
    }
}

RTCBuildPrimitive make_primitive(const Box& box, std::uint32_t number) {
    return {box.lower[0], box.lower[1], box.lower[2], 0, box.upper[0], box.upper[1], box.upper[2], number};
}

bool is_usable(const std::array<float, 3>& p) {
    constexpr float kLargest = 1.844e18f;
    return std::all_of(p.begin(), p.end(), [](float x) { return std::fabs(x) < kLargest; });
}

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

BuiltTree::BuiltTree(RTCDevice device, std::vector<RTCBuildPrimitive> primitives, const TreeShape& shape)
    : bounds_(bounds_of(primitives)), bvh_(rtcNewBVH(device)) {
    check_for_error(device);
    root_ = build(bvh_.get(), primitives, shape);
    check_for_error(device);
}

} // namespace nusselt::visibility
