#pragma once
/// Shadows of the triangles of a block, each for all lines of a light. Compiled for each instruction set; see
/// line_traversal.h.

#include "visibility/line_pyramid.h"
#include "visibility/stored_shadows.h"

#include <nusselt/line_samples/partial_shadow.h>

NUSSELT_NAMESPACE_BEGIN

/// A block of triangles that may touch the pyramid of a light.
class BlockShadows {
public:
    NUSSELT_HD static BlockShadows make(const SeenLight& seen, const LightPyramid& pyramid,
                                        const TracedSpace& space,
                                        const visibility::TriangleBlock& block) noexcept {
        const auto row = [&](int i) { return BvhReal::load(block.corner[i]); };
        const Vec3<BvhReal> corner[] = {
            {row(0), row(1), row(2)}, {row(3), row(4), row(5)}, {row(6), row(7), row(8)}};
        const auto shadows =
            make_triangle_shadow(broadcast<BvhReal>(space.frame), corner[0], corner[1], corner[2]);
        std::uint32_t others = 0;
        for (int i = 0; i < visibility::kBvhWidth; ++i)
            others |= static_cast<std::uint32_t>(block.light[i] != seen.light &&
                                                 block.light[i] != visibility::kNoTriangle)
                      << i;
        const Interval<float>& u = seen.bounds.offsets;
        const Interval<float>& t = seen.bounds.extent;
        const auto whole = may_hide(shadows.shadow,
                                    {{BvhReal(u.begin), BvhReal(u.end)}, {BvhReal(t.begin), BvhReal(t.end)}});
        auto partial = shadows.partial;
        if (any(partial)) partial &= pyramid.touched(corner);
        return {space, block, shadows.shadow, others, whole.bits() & others, partial.bits() & others};
    }

    /// The number of triangles, without those of the light.
    NUSSELT_HD std::uint64_t count() const noexcept {
        return static_cast<std::uint64_t>(__builtin_popcount(others_));
    }

    /// Bit i: triangle i may hide something.
    NUSSELT_HD std::uint32_t relevant() const noexcept { return whole_ | partial_; }

    /// Calls a function with each TriangleShadow or PartialShadow that may hide something.
    template <class Function>
    NUSSELT_INLINE void for_each(const Function& function) const noexcept {
        for (std::uint32_t bits = whole_; bits != 0; bits &= bits - 1)
            function(shadows_[__builtin_ctz(bits)]);
        for (std::uint32_t bits = partial_; bits != 0; bits &= bits - 1)
            function(partial_shadow(__builtin_ctz(bits)));
    }

private:
    NUSSELT_HD BlockShadows(const TracedSpace& space, const visibility::TriangleBlock& block,
                            const TriangleShadow<BvhReal>& shadows, std::uint32_t others, std::uint32_t whole,
                            std::uint32_t partial) noexcept
        : space_(space),
          block_(block),
          shadows_(shadows),
          others_(others),
          whole_(whole),
          partial_(partial) {}

    NUSSELT_HD PartialShadow<float> partial_shadow(int i) const noexcept {
        const auto corner = [&](int k) {
            return Vec3<float>{block_.corner[3 * k][i], block_.corner[3 * k + 1][i],
                               block_.corner[3 * k + 2][i]};
        };
        return make_partial_shadow(space_.frame, corner(0), corner(1), corner(2));
    }

    const TracedSpace& space_;
    const visibility::TriangleBlock& block_;
    StoredShadows<float, visibility::kBvhWidth> shadows_;
    std::uint32_t others_, whole_, partial_; ///< a bit per triangle
};

NUSSELT_NAMESPACE_END
