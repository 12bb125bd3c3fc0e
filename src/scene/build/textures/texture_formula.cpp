#include "scene/build/textures/texture_formula.h"

#include <algorithm>
#include <set>

namespace nusselt::scene {

namespace {

bool is_constant(const TextureValue& value) { return value.node < 0; }
bool is_black(const TextureValue& value) {
    return value.factor.x == 0 && value.factor.y == 0 && value.factor.z == 0;
}
bool is_equal(const TextureValue& a, const TextureValue& b) {
    return a.node == b.node && a.factor.x == b.factor.x && a.factor.y == b.factor.y &&
           a.factor.z == b.factor.z;
}

template <class Function>
Float3 per_channel(const Float3& a, const Float3& b, const Function& function) {
    return {function(a.x, b.x), function(a.y, b.y), function(a.z, b.z)};
}

Float3 times(const Float3& a, const Float3& b) {
    return per_channel(a, b, [](float x, float y) { return x * y; });
}

} // namespace

TextureValue TextureFormulas::add(const TextureNode& node) {
    const auto [entry, is_new] = numbers_.try_emplace(node, static_cast<int>(nodes_.size()));
    if (is_new) nodes_.push_back(node);
    return {{1, 1, 1}, entry->second};
}

int TextureFormulas::node_of(const TextureValue& value) {
    const Float3& f = value.factor;
    const bool is_white = f.x == 1 && f.y == 1 && f.z == 1;
    if (!is_constant(value) && is_white) return value.node;
    TextureNode constant;
    constant.constant = {f.x, f.y, f.z};
    const int factor = add(constant).node;
    if (is_constant(value)) return factor;
    TextureNode product;
    product.operation = TextureOperation::product;
    product.operands = {factor, value.node, -1};
    return add(product).node;
}

TextureValue TextureFormulas::product(const TextureValue& a, const TextureValue& b) {
    TextureValue result;
    result.factor = times(a.factor, b.factor);
    if (is_black(result)) return result;
    if (is_constant(a) || is_constant(b)) {
        result.node = std::max(a.node, b.node);
        return result;
    }
    TextureNode node;
    node.operation = TextureOperation::product;
    node.operands = {std::min(a.node, b.node), std::max(a.node, b.node), -1};
    result.node = add(node).node;
    return result;
}

TextureValue TextureFormulas::mix(const TextureValue& a, const TextureValue& b, const TextureValue& amount) {
    if (is_equal(a, b)) return a;
    if (is_constant(amount)) {
        const auto rest = per_channel(amount.factor, amount.factor, [](float t, float) { return 1 - t; });
        const Float3 from_a = times(a.factor, rest);
        const Float3 from_b = times(b.factor, amount.factor);
        const Float3 sum = per_channel(from_a, from_b, [](float x, float y) { return x + y; });
        if (a.node == b.node) return {sum, a.node};
        if (is_black({from_b, -1})) return {from_a, a.node};
        if (is_black({from_a, -1})) return {from_b, b.node};
    }
    TextureNode node;
    node.operation = TextureOperation::mix;
    node.operands = {node_of(a), node_of(b), node_of(amount)};
    return add(node);
}

TextureValue TextureFormulas::checkerboard(const TextureValue& a, const TextureValue& b,
                                           const TextureMapping& mapping) {
    if (is_equal(a, b)) return a;
    TextureNode node;
    node.operation = TextureOperation::checkerboard;
    node.operands = {node_of(a), node_of(b), -1};
    node.mapping = mapping;
    return add(node);
}

TextureValue TextureFormulas::inverted(const TextureValue& a) {
    if (is_constant(a)) {
        const auto invert = [](float x, float) { return std::max(0.0f, 1 - x); };
        return {per_channel(a.factor, a.factor, invert), -1};
    }
    TextureNode node;
    node.operation = TextureOperation::inversion;
    node.operands[0] = node_of(a);
    return add(node);
}

TextureValue TextureFormulas::roughness(const TextureValue& a, RoughnessRule rule) {
    if (is_constant(a)) {
        const auto convert = [rule](float x, float) {
            return roughness_from_alpha(alpha_from_roughness(static_cast<double>(x), rule));
        };
        return {per_channel(a.factor, a.factor, convert), -1};
    }
    TextureNode node;
    node.operation = TextureOperation::roughness;
    node.operands[0] = node_of(a);
    node.rule = rule;
    return add(node);
}

std::vector<int> formula_nodes(const std::vector<TextureNode>& nodes, int node) {
    std::set<int> found = {node};
    std::vector<int> open = {node};
    while (!open.empty()) {
        const TextureNode& current = nodes[static_cast<std::size_t>(open.back())];
        open.pop_back();
        for (const int operand : current.operands)
            if (operand >= 0 && found.insert(operand).second) open.push_back(operand);
    }
    return {found.begin(), found.end()};
}

} // namespace nusselt::scene
