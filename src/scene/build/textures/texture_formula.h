#pragma once
/// Textures as formulas of constants and images. Equal formulas share a node, so that each is evaluated once.

#include "scene/build/textures/reflectance.h"
#include "scene/model/scene.h"

#include <array>
#include <compare>
#include <map>
#include <vector>

namespace nusselt::scene {

/// A colour, multiplied by a node of a formula unless `node` is -1.
struct TextureValue {
    Float3 factor = {1, 1, 1};
    int node = -1;
};

inline TextureValue grey_value(double v) {
    const auto f = static_cast<float>(v);
    return {{f, f, f}, -1};
}

/// Coordinates scale * uv + offset, for u and v.
struct TextureMapping {
    std::array<float, 2> scale = {1, 1};
    std::array<float, 2> offset = {0, 0};
    auto operator<=>(const TextureMapping&) const = default;
};

enum class TextureOperation {
    constant,     ///< `constant`
    image,        ///< `image`, `wrap`, `filter`, `is_grey` at `mapping`
    checkerboard, ///< the operands 0 and 1 in cells of size 1 at `mapping`; 0 in the cell from (0, 0) to (1, 1)
    product,      ///< of the operands 0 and 1
    mix,          ///< operand 0 * (1 - operand 2) + operand 1 * operand 2
    inversion,    ///< max(0, 1 - operand 0)
    roughness,    ///< perceptual roughness from operand 0 by `rule`
};

struct TextureNode {
    TextureOperation operation = TextureOperation::constant;
    std::array<float, 3> constant = {0, 0, 0};
    std::array<int, 3> operands = {-1, -1, -1}; ///< nodes, which come before this one
    int image = -1;                             ///< index of an ImageRequest
    TextureWrap wrap = TextureWrap::repeat;
    TextureFilter filter = TextureFilter::bilinear;
    bool is_grey = false; ///< the image stands for numbers, not for colours
    TextureMapping mapping;
    RoughnessRule rule = RoughnessRule::alpha;
    auto operator<=>(const TextureNode&) const = default;
};

/// Builds formulas. Computes constants at once, and keeps factors apart from nodes where possible.
class TextureFormulas {
public:
    /// The node with a factor of 1.
    TextureValue add(const TextureNode& node);
    TextureValue product(const TextureValue& a, const TextureValue& b);
    /// a * (1 - amount) + b * amount
    TextureValue mix(const TextureValue& a, const TextureValue& b, const TextureValue& amount);
    TextureValue checkerboard(const TextureValue& a, const TextureValue& b, const TextureMapping& mapping);
    /// max(0, 1 - a)
    TextureValue inverted(const TextureValue& a);
    /// Perceptual roughness from a roughness parameter.
    TextureValue roughness(const TextureValue& a, RoughnessRule rule);

    const std::vector<TextureNode>& nodes() const { return nodes_; }

private:
    /// A node for a value with its factor.
    int node_of(const TextureValue& value);

    std::vector<TextureNode> nodes_;
    std::map<TextureNode, int> numbers_;
};

/// The nodes of a formula in their order; the last one is the formula itself.
std::vector<int> formula_nodes(const std::vector<TextureNode>& nodes, int node);

} // namespace nusselt::scene
