#pragma once
/// The visible parts of the lines of a light. Compiled for each instruction set, like
/// src/render_cpu/kernel: neither standard containers nor algorithms.
///
/// All lines that start at one shading point lie in one pyramid: the hierarchy is traversed once for all of them, close
/// parts first, and only with what is still visible of the lines.

#include "visibility/block_shadows.h"

#include <nusselt/line_samples/visible_parts.h>

NUSSELT_NAMESPACE_BEGIN

/// A line per lane and its visible parts. Lanes without a line have no parts.
template <class Real>
struct TracedLines {
    Real offset; ///< [m]
    VisibleParts<Real> parts;
};

/// The shadows on a pack of lines, subtracted at once: neighbours in a mesh share edges, so that most
/// shadows of a block join.
template <class Real>
class JoinedShadows {
public:
    template <class Shadow>
    NUSSELT_INLINE void add(TracedLines<Real>& lines, const Shadow& shadow,
                            visibility::LineCounters& counters) noexcept {
        join(lines, hidden_interval(shadow, lines.offset), counters);
    }
    NUSSELT_INLINE void add(TracedLines<Real>& lines, const TriangleShadow<float>& shadow,
                            visibility::LineCounters& counters) noexcept {
        const auto crosses = (Real(shadow.first) <= lines.offset) & (lines.offset < Real(shadow.last));
        if (any(crosses & lines.parts.lit()))
            join(lines, hidden_interval(broadcast<Real>(shadow), lines.offset), counters);
    }

    NUSSELT_INLINE void cut(TracedLines<Real>& lines) const noexcept { lines.parts.cut(joined_); }

private:
    NUSSELT_INLINE void join(TracedLines<Real>& lines, const Interval<Real>& interval,
                             visibility::LineCounters& counters) noexcept {
        ++counters.line_tests;
        const auto hides = interval.begin < interval.end; // nothing if NaN
        const Interval<Real> none = empty_interval<Real>();
        const Interval<Real> hidden{select(hides, interval.begin, none.begin),
                                    select(hides, interval.end, none.end)};
        const auto touches = (hidden.begin <= joined_.end) & (hidden.end >= joined_.begin);
        if (all(touches | !hides | (joined_.begin > joined_.end) | !lines.parts.lit())) {
            joined_ = {min(joined_.begin, hidden.begin), max(joined_.end, hidden.end)};
        } else {
            lines.parts.cut(joined_);
            joined_ = hidden;
        }
    }

    Interval<Real> joined_ = empty_interval<Real>();
};

enum class VisitOrder {
    any,
    closest_first, ///< close triangles hide most
};

/// Visits the blocks of triangles that a light may have in its pyramid.
template <VisitOrder order>
class PyramidTraversal {
public:
    NUSSELT_HD PyramidTraversal(const visibility::LineBvhView& bvh, const SeenLight& seen,
                                visibility::LineCounters& counters) noexcept
        : bvh_(bvh), seen_(seen), counters_(counters) {}

    /// \param visitor with functions
    ///        `void enter(space)`: what follows is in these coordinates
    ///        `bool touched(node, bits)`: takes children that are not of interest from the bits; whether to continue
    ///        `bool visit(pyramid, space, block)`: whether to continue
    template <class Visitor>
    NUSSELT_HD void run(const visibility::LineBvhRoots& roots, Visitor& visitor) const noexcept {
        const TracedSpace world = world_space(seen_);
        visitor.enter(world);
        if (roots.triangles != visibility::kEmptyBvh && !walk(roots.triangles, world, visitor)) return;
        if (roots.instances != visibility::kEmptyBvh) walk(roots.instances, world, visitor);
    }

private:
    static constexpr int kStackSize = visibility::kLargestBvhDepth * (visibility::kBvhWidth - 1) + 1;

    /// \returns whether to continue
    template <class Visitor>
    NUSSELT_HD bool walk(std::uint32_t root, const TracedSpace& space, Visitor& visitor) const noexcept {
        const LightPyramid pyramid(seen_, space);
        std::uint32_t stack[kStackSize];
        int size = 0;
        stack[size++] = root;
        while (size > 0) {
            const std::uint32_t reference = stack[--size];
            const std::uint32_t index = reference & ~visibility::kBvhKindMask;
            switch (reference & visibility::kBvhKindMask) {
            case visibility::kBvhNode:
                if (!push_children(bvh_.nodes[index], pyramid, space, visitor, stack, size)) return false;
                break;
            case visibility::kBvhBlock:
                if (!visitor.visit(pyramid, space, bvh_.blocks[index])) return false;
                break;
            default: {
                const visibility::LineBvhInstance& instance = bvh_.instances[index];
                const TracedSpace object = object_space(seen_, instance);
                visitor.enter(object);
                if (!walk(instance.triangles, object, visitor)) return false;
                visitor.enter(space);
            }
            }
        }
        return true;
    }

    /// \returns whether to continue
    template <class Visitor>
    NUSSELT_INLINE bool push_children(const visibility::LineBvhNode& node, const LightPyramid& pyramid,
                                      const TracedSpace& space, Visitor& visitor, std::uint32_t* stack,
                                      int& size) const noexcept {
        counters_.box_tests += visibility::kBvhWidth;
        std::uint32_t bits = pyramid.touched(node).bits();
        if (bits == 0) return true;
        if (!visitor.touched(node, bits)) return false;
        if (bits == 0) return true;
        if constexpr (order == VisitOrder::any) {
            for (; bits != 0; bits &= bits - 1) {
                stack[size] = node.child[__builtin_ctz(bits)];
                prefetch(stack[size++]);
            }
        } else {
            push_closest_last(node, bits, space, stack, size);
        }
        return true;
    }

    NUSSELT_INLINE void push_closest_last(const visibility::LineBvhNode& node, std::uint32_t bits,
                                          const TracedSpace& space, std::uint32_t* stack,
                                          int& size) const noexcept {
        float depth[visibility::kBvhWidth];
        depths(node, space).store(depth);
        float depth_of[visibility::kBvhWidth];
        const int first = size;
        for (; bits != 0; bits &= bits - 1) {
            const int child = __builtin_ctz(bits);
            prefetch(node.child[child]);
            int k = size++;
            for (; k > first && depth_of[k - 1 - first] < depth[child]; --k) {
                stack[k] = stack[k - 1];
                depth_of[k - first] = depth_of[k - 1 - first];
            }
            stack[k] = node.child[child];
            depth_of[k - first] = depth[child];
        }
    }

    /// Memory is what takes most of the time in large scenes.
    NUSSELT_INLINE void prefetch(std::uint32_t reference) const noexcept {
        const std::uint32_t index = reference & ~visibility::kBvhKindMask;
        const std::uint32_t kind = reference & visibility::kBvhKindMask;
        constexpr int kLine = 64;
        if (kind == visibility::kBvhNode) {
            const auto* begin = reinterpret_cast<const char*>(bvh_.nodes + index);
            for (std::size_t i = 0; i < sizeof(visibility::LineBvhNode); i += kLine)
                __builtin_prefetch(begin + i);
        } else if (kind == visibility::kBvhBlock) {
            const auto* begin = reinterpret_cast<const char*>(bvh_.blocks + index);
            for (std::size_t i = 0; i < sizeof(visibility::TriangleBlock); i += kLine)
                __builtin_prefetch(begin + i);
        }
    }

    /// Twice the depths of the centres of boxes, up to a constant.
    NUSSELT_INLINE static BvhReal depths(const visibility::LineBvhNode& node,
                                         const TracedSpace& space) noexcept {
        const auto sum = [&](int axis) {
            return BvhReal::load(node.bounds[axis]) + BvhReal::load(node.bounds[axis + 3]);
        };
        const Vec3<float>& n = space.frame.normal;
        return fma(BvhReal(n.x), sum(0), fma(BvhReal(n.y), sum(1), BvhReal(n.z) * sum(2)));
    }

    const visibility::LineBvhView& bvh_;
    const SeenLight& seen_;
    visibility::LineCounters& counters_;
};

/// Whether more than some number of blocks of triangles have boxes in the pyramid of a light: how many tells what tracing
/// lines will cost. Depends on the direction of lines, by rounding, and on nothing else of them: with a light that is
/// seen along a fixed direction, decisions are functions of the light and the point.
NUSSELT_HD inline bool has_many_occluders(const visibility::LineBvhView& bvh, const SeenLight& seen,
                                          int bound, visibility::LineCounters& counters) noexcept {
    struct Counter {
        int bound;
        int count;

        void enter(const TracedSpace&) const noexcept {}
        NUSSELT_INLINE bool touched(const visibility::LineBvhNode& node, std::uint32_t& bits) noexcept {
            std::uint32_t others = 0;
            for (; bits != 0; bits &= bits - 1) {
                const int child = __builtin_ctz(bits);
                const bool is_block = (node.child[child] & visibility::kBvhKindMask) == visibility::kBvhBlock;
                count += is_block;
                others |= static_cast<std::uint32_t>(!is_block) << child;
            }
            bits = others;
            return count <= bound;
        }
        bool visit(const LightPyramid&, const TracedSpace&, const visibility::TriangleBlock&) noexcept {
            return ++count <= bound;
        }
    };
    if (bvh.full_block_count <= static_cast<std::uint64_t>(bound) || !seen.is_visible()) return false;
    Counter counter{bound, 0};
    PyramidTraversal<VisitOrder::any>(bvh, seen, counters).run(bvh.full, counter);
    return counter.count > bound;
}

/// Whether a light has surfaces in its pyramid that are partially opaque (an alpha below 1): lines cannot decide what
/// is visible, take points. Depends on the direction of lines, as triangles count that reach into the rectangle around
/// the light along it: take the same fixed direction as for has_many_occluders().
NUSSELT_HD inline bool has_partial_surfaces(const visibility::LineBvhView& bvh, const SeenLight& seen,
                                            visibility::LineCounters& counters) noexcept {
    struct Finder {
        const SeenLight& seen;
        visibility::LineCounters& counters;
        bool found;

        void enter(const TracedSpace&) const noexcept {}
        bool touched(const visibility::LineBvhNode&, std::uint32_t&) const noexcept { return true; }
        bool visit(const LightPyramid& pyramid, const TracedSpace& space,
                   const visibility::TriangleBlock& block) noexcept {
            const BlockShadows shadows = BlockShadows::make(seen, pyramid, space, block);
            counters.triangle_tests += shadows.count();
            found = shadows.relevant() != 0;
            return !found;
        }
    };
    Finder finder{seen, counters, false};
    if (seen.is_visible()) PyramidTraversal<VisitOrder::any>(bvh, seen, counters).run(bvh.partial, finder);
    return finder.found;
}

/// Packs of lines that LineTracer takes at once.
inline constexpr int kLargestLinePackCount = 8;

/// Takes what triangles hide from packs of lines: nodes that no line with light touches are skipped.
template <class Real>
class LineTracer {
public:
    /// \param pack_count at most kLargestLinePackCount
    NUSSELT_HD LineTracer(const visibility::LineBvhView& bvh, const SeenLight& seen, TracedLines<Real>* packs,
                          int pack_count, visibility::LineCounters& counters) noexcept
        : bvh_(bvh), seen_(seen), packs_(packs), pack_count_(pack_count), counters_(counters) {}

    /// Lines of lights that are not visible at all lose all their parts.
    NUSSELT_HD void trace() noexcept {
        if (!seen_.is_visible()) {
            for (int p = 0; p < pack_count_; ++p) packs_[p].parts.reset({Real(0), Real(0)});
            return;
        }
        PyramidTraversal<VisitOrder::closest_first>(bvh_, seen_, counters_).run(bvh_.full, *this);
    }

    void enter(const TracedSpace& space) noexcept {
        space_ = &space;
        const Vec3<float>& origin = seen_.frame.origin;
        const auto size = [](const Vec3<float>& v) { return abs(v.x) + abs(v.y) + abs(v.z); };
        for (int p = 0; p < pack_count_; ++p) {
            const Real x = packs_[p].offset + origin.x;
            const auto slope = [&](float across, float normal) {
                return abs(fma(Real(origin.z), Real(across), -x * Real(normal)));
            };
            slope_[p] = {slope(space.frame.across.x, space.frame.normal.x),
                         slope(space.frame.across.y, space.frame.normal.y),
                         slope(space.frame.across.z, space.frame.normal.z)};
            margin_[p] = Real(kTraversalRounding) *
                         fma(abs(x), Real(size(space.frame.normal)), origin.z * size(space.frame.across));
        }
        rounding_ = kTraversalRounding * (size(space.frame.along) + size(space.frame.normal));
        along_margin_ =
            kTraversalRounding * (abs(origin.y) + max(-seen_.bounds.extent.begin, seen_.bounds.extent.end));
    }

    NUSSELT_INLINE bool touched(const visibility::LineBvhNode& node, std::uint32_t& bits) noexcept {
        const auto row = [&](int i) { return BvhReal::load(node.bounds[i]); };
        const Vec3<BvhReal> half{BvhReal(0.5f) * (row(3) - row(0)), BvhReal(0.5f) * (row(4) - row(1)),
                                 BvhReal(0.5f) * (row(5) - row(2))};
        const Vec3<BvhReal> centre =
            space_->seen(Vec3<BvhReal>{row(0) + half.x, row(1) + half.y, row(2) + half.z});
        Boxes boxes;
        centre.x.store(boxes.centre[0]);
        centre.y.store(boxes.centre[1]);
        centre.z.store(boxes.centre[2]);
        half.x.store(boxes.half[0]);
        half.y.store(boxes.half[1]);
        half.z.store(boxes.half[2]);
        const BvhReal size = max(sizes_of(node), BvhReal(space_->apex));
        size.store(boxes.size);
        store_extent(centre, half, size, boxes);
        std::uint32_t result = 0;
        for (; bits != 0; bits &= bits - 1) {
            const int child = __builtin_ctz(bits);
            result |= static_cast<std::uint32_t>(touches(boxes, child)) << child;
        }
        bits = result;
        return true;
    }

    NUSSELT_INLINE bool visit(const LightPyramid& pyramid, const TracedSpace& space,
                              const visibility::TriangleBlock& block) noexcept {
        const BlockShadows shadows = BlockShadows::make(seen_, pyramid, space, block);
        counters_.triangle_tests += shadows.count();
        for (int p = 0; p < pack_count_; ++p) {
            JoinedShadows<Real> joined;
            shadows.for_each([&](const auto& shadow) { joined.add(packs_[p], shadow, counters_); });
            joined.cut(packs_[p]);
        }
        return is_lit();
    }

private:
    /// The boxes of a node in the axes of the frame; half sizes in their own axes.
    struct Boxes {
        alignas(64) float centre[3][visibility::kBvhWidth];
        float half[3][visibility::kBvhWidth];
        float size[visibility::kBvhWidth]; ///< largest coordinate of the box and the point, in their own axes
        float begin[visibility::kBvhWidth]; ///< of their projections, along the lines [m]
        float end[visibility::kBvhWidth];
    };

    bool is_lit() const noexcept {
        for (int p = 0; p < pack_count_; ++p)
            if (any(packs_[p].parts.lit())) return true;
        return false;
    }

    /// Finds where along the lines their projections are.
    NUSSELT_INLINE void store_extent(const Vec3<BvhReal>& centre, const Vec3<BvhReal>& half,
                                     const BvhReal& size, Boxes& boxes) const noexcept {
        const BvhReal rounding = BvhReal(rounding_) * size;
        const auto extent = [&](const Vec3<float>& r) {
            return fma(abs(BvhReal(r.x)), half.x,
                       fma(abs(BvhReal(r.y)), half.y, fma(abs(BvhReal(r.z)), half.z, rounding)));
        };
        const Vec3<float>& origin = seen_.frame.origin;
        const BvhReal along = extent(space_->frame.along);
        const BvhReal normal = extent(space_->frame.normal);
        const BvhReal nearest = centre.z - normal;
        const BvhReal to_nearest = BvhReal(origin.z) / nearest;
        const BvhReal to_farthest = BvhReal(origin.z) / (centre.z + normal);
        const BvhReal low = centre.y - along;
        const BvhReal high = centre.y + along;
        const BvhReal begin = min(low * to_nearest, low * to_farthest) - BvhReal(origin.y);
        const BvhReal end = max(high * to_nearest, high * to_farthest) - BvhReal(origin.y);
        const auto projects = nearest > BvhReal(0);
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        select(projects, begin - BvhReal(along_margin_), BvhReal(-kInfinity)).store(boxes.begin);
        select(projects, end + BvhReal(along_margin_), BvhReal(kInfinity)).store(boxes.end);
    }

    /// Whether any line with light touches a box.
    NUSSELT_INLINE bool touches(const Boxes& boxes, int child) const noexcept {
        ++counters_.box_tests;
        const Vec3<float>& origin = seen_.frame.origin;
        const Real x = origin.z * boxes.centre[0][child];
        const Real z = boxes.centre[2][child];
        const Interval<Real> extent{Real(boxes.begin[child]), Real(boxes.end[child])};
        const Real size(boxes.size[child]);
        for (int p = 0; p < pack_count_; ++p) {
            const Vec3<Real>& slope = slope_[p];
            const Real side = x - (packs_[p].offset + origin.x) * z;
            const Real reach = fma(slope.x, Real(boxes.half[0][child]),
                                   fma(slope.y, Real(boxes.half[1][child]),
                                       fma(slope.z, Real(boxes.half[2][child]), size * margin_[p])));
            const auto crosses = abs(side) <= reach;
            if (any(crosses & packs_[p].parts.lit()) && any(crosses & packs_[p].parts.overlap(extent)))
                return true;
        }
        return false;
    }

    const visibility::LineBvhView& bvh_;
    const SeenLight& seen_;
    TracedLines<Real>* packs_;
    int pack_count_;
    visibility::LineCounters& counters_;
    const TracedSpace* space_ = nullptr;
    // Per line: size of the components of the gradient of the plane through the line and the apex, and its rounding as
    // a share of coordinates.
    Vec3<Real> slope_[kLargestLinePackCount];
    Real margin_[kLargestLinePackCount];
    float rounding_ = 0;     ///< of coordinates in the axes of the frame, as a share of those of their own
    float along_margin_ = 0; ///< of coordinates along lines [m]
};

NUSSELT_NAMESPACE_END
