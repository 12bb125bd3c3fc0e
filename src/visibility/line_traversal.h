#pragma once
/// What triangles of a scene hide of the lines of a light. Compiled for each instruction set, like
/// src/render_cpu/kernel: neither standard containers nor algorithms.
///
/// All lines that start at one shading point lie in one pyramid. OccluderList collects what is in it: that needs no
/// lines, so that decisions based on it are independent of their offsets. Then lines are cut by the list. Where it would
/// be long, trace_lines() traverses the hierarchy with the lines that still have light.

#include "visibility/block_shadows.h"

NUSSELT_NAMESPACE_BEGIN

/// A line per lane and what is visible of it. Lanes without a line have no parts.
template <class Real>
struct TracedLines {
    Real offset; ///< [m]
    VisibleParts<Real> parts;
};

/// Takes a shadow from a pack of lines.
template <class Real, class Shadow>
NUSSELT_INLINE void cut_lines(TracedLines<Real>& lines, const Shadow& shadow,
                              visibility::LineCounters& counters) noexcept {
    ++counters.line_tests;
    lines.parts.cut(hidden_interval(shadow, lines.offset));
}
template <class Real>
NUSSELT_INLINE void cut_lines(TracedLines<Real>& lines, const TriangleShadow<float>& shadow,
                              visibility::LineCounters& counters) noexcept {
    const auto crosses = (Real(shadow.first) <= lines.offset) & (lines.offset < Real(shadow.last));
    if (any(crosses & lines.parts.lit())) cut_lines(lines, broadcast<Real>(shadow), counters);
}

/// Visits the blocks of triangles that a light may have in its pyramid, those close to its apex first.
class PyramidTraversal {
public:
    NUSSELT_HD PyramidTraversal(const visibility::LineBvhView& bvh, const SeenLight& seen,
                                visibility::LineCounters& counters) noexcept
        : bvh_(bvh), seen_(seen), counters_(counters) {}

    /// \param visitor with functions
    ///        `void enter(space)`: what follows is in these coordinates
    ///        `uint32_t touched(node, bits)`: those of the children that are of interest
    ///        `bool visit(shadows)`: whether to go on, with the BlockShadows of a block
    template <class Visitor>
    NUSSELT_HD void run(const visibility::LineBvhRoots& roots, Visitor& visitor) const noexcept {
        const TracedSpace world = world_space(seen_, bvh_.extent);
        visitor.enter(world);
        if (roots.triangles != visibility::kEmptyBvh && !walk(roots.triangles, world, visitor)) return;
        if (roots.instances != visibility::kEmptyBvh) walk(roots.instances, world, visitor);
    }

private:
    static constexpr int kStackSize = visibility::kLargestBvhDepth * (visibility::kBvhWidth - 1) + 1;

    /// \returns whether to go on
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
                push_children(bvh_.nodes[index], pyramid, space, visitor, stack, size);
                break;
            case visibility::kBvhBlock:
                if (!visit(bvh_.blocks[index], pyramid, space, visitor)) return false;
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

    template <class Visitor>
    NUSSELT_INLINE bool visit(const visibility::TriangleBlock& block, const LightPyramid& pyramid,
                              const TracedSpace& space, Visitor& visitor) const noexcept {
        counters_.triangle_tests += visibility::kBvhWidth;
        const BlockShadows shadows = BlockShadows::make(seen_, pyramid, space, block);
        return shadows.relevant() == 0 || visitor.visit(shadows);
    }

    /// The closest child on top.
    template <class Visitor>
    NUSSELT_INLINE void push_children(const visibility::LineBvhNode& node, const LightPyramid& pyramid,
                                      const TracedSpace& space, Visitor& visitor, std::uint32_t* stack,
                                      int& size) const noexcept {
        counters_.box_tests += visibility::kBvhWidth;
        std::uint32_t bits = pyramid.touched(node).bits();
        if (bits != 0) bits = visitor.touched(node, bits);
        if (bits == 0) return;
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
            for (std::size_t i = 0; i < sizeof(visibility::LineBvhNode); i += kLine) __builtin_prefetch(begin + i);
        } else if (kind == visibility::kBvhBlock) {
            const auto* begin = reinterpret_cast<const char*>(bvh_.blocks + index);
            for (std::size_t i = 0; i < sizeof(visibility::TriangleBlock); i += kLine) __builtin_prefetch(begin + i);
        }
    }

    /// Twice the depths of the centres of boxes, but for a constant.
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

/// Room for occluders.
struct OccluderStorage {
    static constexpr int kCapacity = 1024;
    static constexpr int kPartialCapacity = 64;

    TriangleShadow<float> whole[kCapacity];
    PartialShadow<float> partial[kPartialCapacity];
};

/// What a list of occluders says about a light.
enum class Occluders {
    listed,   ///< all are in the list
    hide_all, ///< nothing of the light is visible
    too_many, ///< the list is not complete
    partial,  ///< some are only partly there (an alpha below 1): lines cannot tell, take points
};

/// The triangles between a point and a light, in memory of the caller.
class OccluderList {
public:
    /// \param storage  outlives this object.
    /// \param capacity number of occluders from which on they are too many, at most OccluderStorage::kCapacity.
    NUSSELT_HD OccluderList(OccluderStorage& storage, int capacity) noexcept
        : storage_(storage), capacity_(capacity) {}

    /// Replaces the list. The result does not depend on the offsets of lines.
    NUSSELT_HD Occluders collect(const visibility::LineBvhView& bvh, const SeenLight& seen,
                                 visibility::LineCounters& counters) noexcept {
        count_ = partial_count_ = 0;
        if (!seen.is_visible()) return Occluders::hide_all;
        const PyramidTraversal traversal(bvh, seen, counters);
        Collector collector{*this, seen, Occluders::listed};
        traversal.run(bvh.full, collector);
        if (collector.result == Occluders::hide_all) return Occluders::hide_all;
        Finder finder{false};
        traversal.run(bvh.partial, finder);
        return finder.found ? Occluders::partial : collector.result;
    }

    NUSSELT_HD int count() const noexcept { return count_ + partial_count_; }

    /// Takes what the listed triangles hide from packs of lines.
    template <class Real>
    NUSSELT_HD void cut(TracedLines<Real>* packs, int pack_count,
                        visibility::LineCounters& counters) const noexcept {
        for (int p = 0; p < pack_count; ++p) {
            for (int i = 0; i < partial_count_; ++i) cut_lines(packs[p], storage_.partial[i], counters);
            for (int i = 0; i < count_ && any(packs[p].parts.lit()); ++i)
                cut_lines(packs[p], storage_.whole[i], counters);
        }
    }

private:
    struct Collector {
        OccluderList& list;
        const SeenLight& seen;
        Occluders result;

        void enter(const TracedSpace&) const noexcept {}
        std::uint32_t touched(const visibility::LineBvhNode&, std::uint32_t bits) const noexcept {
            return bits;
        }

        NUSSELT_INLINE bool visit(const BlockShadows& shadows) noexcept {
            return shadows.for_each([&](const auto& shadow) {
                if (covers(shadow))
                    result = Occluders::hide_all;
                else if (!list.add(shadow))
                    result = Occluders::too_many;
                return result == Occluders::listed;
            });
        }

        /// Whether the whole light is hidden.
        NUSSELT_INLINE bool covers(const TriangleShadow<float>& shadow) const noexcept {
            return shadow.first <= seen.bounds.offsets.begin && shadow.last >= seen.bounds.offsets.end &&
                   covers_corners(shadow);
        }
        NUSSELT_HD bool covers(const PartialShadow<float>& shadow) const noexcept {
            return covers_corners(shadow);
        }
        template <class Shadow>
        NUSSELT_HD bool covers_corners(const Shadow& shadow) const noexcept {
            for (int j = 0; j < seen.corner_count; ++j) {
                const Interval<float> hidden =
                    hidden_interval(shadow, seen.corner[j].x - seen.frame.origin.x);
                const float t = seen.corner[j].y - seen.frame.origin.y;
                if (!(hidden.begin <= t && t <= hidden.end)) return false;
            }
            return true;
        }
    };

    /// Whether there is anything.
    struct Finder {
        bool found;

        void enter(const TracedSpace&) const noexcept {}
        std::uint32_t touched(const visibility::LineBvhNode&, std::uint32_t bits) const noexcept {
            return bits;
        }
        bool visit(const BlockShadows&) noexcept {
            found = true;
            return false;
        }
    };

    /// \returns whether there was room
    NUSSELT_INLINE bool add(const TriangleShadow<float>& shadow) noexcept {
        if (count() >= capacity_) return false;
        storage_.whole[count_++] = shadow;
        return true;
    }
    NUSSELT_INLINE bool add(const PartialShadow<float>& shadow) noexcept {
        if (count() >= capacity_ || partial_count_ == OccluderStorage::kPartialCapacity) return false;
        storage_.partial[partial_count_++] = shadow;
        return true;
    }

    OccluderStorage& storage_;
    int capacity_;
    int count_ = 0;
    int partial_count_ = 0;
};

/// Packs of lines that trace_lines() takes at once.
inline constexpr int kLargestLinePackCount = 16;

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
        PyramidTraversal(bvh_, seen_, counters_).run(bvh_.full, *this);
    }

    void enter(const TracedSpace& space) noexcept {
        space_ = &space;
        const Vec3<float>& origin = seen_.frame.origin;
        const auto size = [](const Vec3<float>& v) { return abs(v.x) + abs(v.y) + abs(v.z); };
        const float rounding = kTraversalRounding * space.extent;
        for (int p = 0; p < pack_count_; ++p) {
            const Real x = packs_[p].offset + origin.x;
            const auto slope = [&](float across, float normal) {
                return abs(fma(Real(origin.z), Real(across), -x * Real(normal)));
            };
            slope_[p] = {slope(space.frame.across.x, space.frame.normal.x),
                         slope(space.frame.across.y, space.frame.normal.y),
                         slope(space.frame.across.z, space.frame.normal.z)};
            margin_[p] = Real(rounding) *
                         fma(abs(x), Real(size(space.frame.normal)), origin.z * size(space.frame.across));
        }
        along_margin_ =
            rounding * (origin.z * size(space.frame.along) +
                        (abs(origin.y) + max(-seen_.bounds.extent.begin, seen_.bounds.extent.end)) *
                            size(space.frame.normal));
    }

    NUSSELT_INLINE std::uint32_t touched(const visibility::LineBvhNode& node, std::uint32_t bits) noexcept {
        const auto row = [&](int i) { return BvhReal::load(node.bounds[i]); };
        const Vec3<BvhReal> half{BvhReal(0.5f) * (row(3) - row(0)), BvhReal(0.5f) * (row(4) - row(1)),
                                 BvhReal(0.5f) * (row(5) - row(2))};
        const Vec3<BvhReal> centre =
            space_->seen(Vec3<BvhReal>{row(0) + half.x, row(1) + half.y, row(2) + half.z});
        const auto extent = [&](const Vec3<float>& r) {
            return fma(abs(BvhReal(r.x)), half.x, fma(abs(BvhReal(r.y)), half.y, abs(BvhReal(r.z)) * half.z));
        };
        Boxes boxes;
        centre.x.store(boxes.centre[0]);
        centre.y.store(boxes.centre[1]);
        centre.z.store(boxes.centre[2]);
        half.x.store(boxes.half[0]);
        half.y.store(boxes.half[1]);
        half.z.store(boxes.half[2]);
        extent(space_->frame.along).store(boxes.extent_along);
        extent(space_->frame.normal).store(boxes.extent_normal);
        std::uint32_t result = 0;
        for (; bits != 0; bits &= bits - 1) {
            const int child = __builtin_ctz(bits);
            result |= static_cast<std::uint32_t>(touches(boxes, child)) << child;
        }
        return result;
    }

    NUSSELT_INLINE bool visit(const BlockShadows& shadows) noexcept {
        return shadows.for_each([&](const auto& shadow) {
            for (int p = 0; p < pack_count_; ++p) cut_lines(packs_[p], shadow, counters_);
            return true;
        }) && is_lit();
    }

private:
    /// The boxes of a node in the axes of the frame; half sizes in their own axes.
    struct Boxes {
        alignas(64) float centre[3][visibility::kBvhWidth];
        float half[3][visibility::kBvhWidth];
        float extent_along[visibility::kBvhWidth];
        float extent_normal[visibility::kBvhWidth];
    };

    bool is_lit() const noexcept {
        for (int p = 0; p < pack_count_; ++p)
            if (any(packs_[p].parts.lit())) return true;
        return false;
    }

    /// Whether any line with light touches a box.
    NUSSELT_INLINE bool touches(const Boxes& boxes, int child) const noexcept {
        ++counters_.box_tests;
        const Vec3<float>& origin = seen_.frame.origin;
        const Real x = boxes.centre[0][child];
        const Real y = origin.z * boxes.centre[1][child];
        const Real z = boxes.centre[2][child];
        const Real reach_y = origin.z * boxes.extent_along[child] + along_margin_;
        const Real reach_z = boxes.extent_normal[child];
        for (int p = 0; p < pack_count_; ++p) {
            const Vec3<Real>& slope = slope_[p];
            const Real side = fma(Real(origin.z), x, -(packs_[p].offset + origin.x) * z);
            const Real reach = fma(slope.x, Real(boxes.half[0][child]),
                                   fma(slope.y, Real(boxes.half[1][child]),
                                       fma(slope.z, Real(boxes.half[2][child]), margin_[p])));
            const Real begin = packs_[p].parts.bounds().begin + origin.y;
            const Real end = packs_[p].parts.bounds().end + origin.y;
            const auto above = fma(-begin, z, y) + fma(abs(begin), reach_z, reach_y) >= Real(0);
            const auto below = fma(-end, z, y) - fma(abs(end), reach_z, reach_y) <= Real(0);
            if (any(packs_[p].parts.lit() & (abs(side) <= reach) & above & below)) return true;
        }
        return false;
    }

    const visibility::LineBvhView& bvh_;
    const SeenLight& seen_;
    TracedLines<Real>* packs_;
    int pack_count_;
    visibility::LineCounters& counters_;
    const TracedSpace* space_ = nullptr;
    // Per line: size of the components of the gradient of the plane through the line and the apex, and rounding.
    Vec3<Real> slope_[kLargestLinePackCount];
    Real margin_[kLargestLinePackCount];
    float along_margin_ = 0;
};

NUSSELT_NAMESPACE_END
