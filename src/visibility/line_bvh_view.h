#pragma once
/// The hierarchy that lines are traced with, as plain data: kernels compiled for other instruction sets read it. No
/// type of the library appears here, nor any inline function.

#include <cstdint>

namespace nusselt::visibility {

/// Children of a node, and triangles of a block.
inline constexpr int kBvhWidth = 8;
/// The largest depth of the hierarchy of the world or of an object, in nodes. Halving 2^32 triangles eight ways needs
/// 11, triangles whose sizes are a geometric series over the range of float need 36.
inline constexpr int kLargestBvhDepth = 40;

/// The kind of a child, in the two highest bits of its reference; the rest is an index.
inline constexpr std::uint32_t kBvhNode = 0;
inline constexpr std::uint32_t kBvhBlock = std::uint32_t{1} << 30;
inline constexpr std::uint32_t kBvhInstance = std::uint32_t{2} << 30;
inline constexpr std::uint32_t kBvhKindMask = std::uint32_t{3} << 30;

/// Children by their boxes. Those that do not exist have lower bounds of infinity, upper ones of minus infinity.
struct alignas(64) LineBvhNode {
    float bounds[6][kBvhWidth]; ///< lower x, y, z, then upper x, y, z [m]
    std::uint32_t child[kBvhWidth];
};

/// TriangleBlock::light of slots without a triangle.
inline constexpr std::int32_t kNoTriangle = -2;

/// Triangles. Unused slots hold finite coordinates.
struct alignas(64) TriangleBlock {
    /// x, y, z of the first, second and third corner [m], in lexicographic order: the same for all triangles that share
    /// them.
    float corner[9][kBvhWidth];
    std::int32_t light[kBvhWidth]; ///< as Scene::triangle_light, -1 for surfaces that do not emit
};

/// No reference: nothing is there.
inline constexpr std::uint32_t kEmptyBvh = ~std::uint32_t{0};

/// The start of traversal: references to hierarchies in world space, or kEmptyBvh.
struct LineBvhRoots {
    std::uint32_t triangles; ///< of the world
    std::uint32_t instances;
};

/// A copy of an object.
struct LineBvhInstance {
    float world_from_object[9];  ///< the linear part in rows
    float object_from_world[12]; ///< as Instance::world_from_object
    std::uint32_t triangles;     ///< reference to those of the object
};

struct LineBvhView {
    const LineBvhNode* nodes;
    const TriangleBlock* blocks;
    const LineBvhInstance* instances;
    LineBvhRoots full;    ///< surfaces that rays always hit
    LineBvhRoots partial; ///< surfaces that rays hit with a probability, see alpha.h
    /// The number of blocks of surfaces that rays always hit, counted once per instance of an object.
    std::uint64_t full_block_count;
};

/// Work done for lines.
struct LineCounters {
    std::uint64_t box_tests;      ///< boxes against pyramids or groups of lines
    std::uint64_t triangle_tests; ///< triangles whose shadows were found, without those of the light
    std::uint64_t line_tests;     ///< shadows against packs of lines
};

} // namespace nusselt::visibility
