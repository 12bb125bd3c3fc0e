#include "scene/build/textures/texture_domain.h"

#include <algorithm>
#include <cmath>

namespace nusselt::scene {

namespace {

/// Periods must agree up to this fraction.
constexpr double kTolerance = 1e-4;
/// The largest length of a grid along an axis, unless an image is longer.
constexpr double kMaxSize = 2048;

/// A leaf repeats with period 1 in these coordinates.
TextureMapping unit_mapping(const TextureNode& leaf) {
    TextureMapping mapping = leaf.mapping;
    if (leaf.operation != TextureOperation::checkerboard) return mapping;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        mapping.scale[axis] *= 0.5f;
        mapping.offset[axis] *= 0.5f;
    }
    return mapping;
}

/// The number of periods at scale `a` in one period at scale `b`, if that is an integer; else 0.
double integer_ratio(double a, double b) {
    const double ratio = std::fabs(a / b);
    const double rounded = std::round(ratio);
    return std::fabs(ratio - rounded) <= kTolerance * ratio ? rounded : 0;
}

/// The scale whose period is a period of both, 0 if there is none. Scales of 0 have every period.
double common_scale(double a, double b) {
    if (a == 0 || b == 0) return a + b;
    if (integer_ratio(a, b) > 0) return b;
    return integer_ratio(b, a) > 0 ? a : 0;
}

/// Extends a domain so that another leaf is periodic, too. \returns false if that is impossible
bool join(TextureMapping& domain, const TextureMapping& leaf) {
    if (domain == leaf) return true;
    TextureMapping joined;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double a = domain.scale[axis];
        const double b = leaf.scale[axis];
        const double scale = common_scale(a, b);
        if (scale == 0 && (a != 0 || b != 0)) return false;
        joined.scale[axis] = static_cast<float>(scale);
    }
    domain = joined;
    return true;
}

} // namespace

TextureDomain find_domain(const std::vector<TextureNode>& nodes, const std::vector<int>& leaves,
                          const std::vector<std::array<int, 2>>& sizes) {
    TextureDomain domain;
    const auto node_of = [&](std::size_t i) -> const TextureNode& {
        return nodes[static_cast<std::size_t>(leaves[i])];
    };
    domain.mapping = unit_mapping(node_of(0));
    domain.wrap = node_of(0).wrap;
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const TextureMapping mapping = unit_mapping(node_of(i));
        // A texture that does not repeat cannot be extended beyond its border.
        const bool may_join = domain.wrap == TextureWrap::repeat || domain.mapping == mapping;
        if (may_join && node_of(i).wrap == domain.wrap && join(domain.mapping, mapping))
            members.push_back(i);
        else
            domain.misfits.push_back(leaves[i]);
    }
    for (const std::size_t i : members) {
        const TextureNode& leaf = node_of(i);
        const bool is_checkerboard = leaf.operation == TextureOperation::checkerboard;
        if (!is_checkerboard && leaf.filter == TextureFilter::bilinear)
            domain.filter = TextureFilter::bilinear;
        const TextureMapping mapping = unit_mapping(leaf);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double scale = domain.mapping.scale[axis];
            const double periods = scale == 0 ? 1 : std::fabs(mapping.scale[axis] / scale);
            const double texels = is_checkerboard ? 2 : sizes[i][axis];
            const double wanted = std::max(1.0, std::round(periods * texels));
            const double limit = std::max(kMaxSize, texels);
            domain.is_coarse = domain.is_coarse || wanted > limit;
            domain.size[axis] = std::max(domain.size[axis], static_cast<int>(std::min(wanted, limit)));
        }
    }
    return domain;
}

} // namespace nusselt::scene
