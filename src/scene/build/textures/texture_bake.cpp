#include "scene/build/textures/texture_bake.h"

#include "scene/build/parallel.h"
#include "scene/build/textures/texture_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tbb/parallel_for.h>
#include <utility>

namespace nusselt::scene {

namespace {

/// The most steps of a formula: no artist writes longer ones, and each step costs time for each texel.
constexpr std::size_t kMaxFormulaLength = 64;

using Texel = std::array<float, 3>;

template <class Function>
Texel per_channel(const Function& function) {
    return {function(0), function(1), function(2)};
}

float mean(const Texel& texel) { return (texel[0] + texel[1] + texel[2]) / 3; }

Texel texel_at(const Texture& image, std::size_t index, const TextureNode& leaf) {
    const auto channels = static_cast<std::size_t>(image.channels);
    const float* entry = image.texels.data() + channels * index;
    if (channels == 1) return {entry[0], entry[0], entry[0]};
    const Texel colour = {entry[0], entry[1], entry[2]};
    if (!leaf.is_grey) return colour;
    const float grey = channels == 4 ? entry[3] : mean(colour);
    return {grey, grey, grey};
}

Texel mean_texel(const Texture& image, const TextureNode& leaf) {
    std::array<double, 3> sum = {0, 0, 0};
    const std::size_t count = image.texels.size() / static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < count; ++i) {
        const Texel texel = texel_at(image, i, leaf);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<double>(texel[c]);
    }
    return per_channel(
        [&](std::size_t c) { return static_cast<float>(sum[c] / static_cast<double>(count)); });
}

/// A row or column number; -1 outside of a texture that is black there.
int wrapped(double index, int size, TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::repeat:
        return static_cast<int>(index - size * std::floor(index / size));
    case TextureWrap::clamp:
        return static_cast<int>(std::clamp(index, 0.0, size - 1.0));
    case TextureWrap::black:
        break;
    }
    return index >= 0 && index < size ? static_cast<int>(index) : -1;
}

Texel look_up(const Texture& image, const TextureNode& leaf, double x, double y) {
    const auto texel = [&](double column, double row) -> Texel {
        const int i = wrapped(column, image.width, leaf.wrap);
        const int j = wrapped(row, image.height, leaf.wrap);
        if (i < 0 || j < 0) return {0, 0, 0};
        const auto index = static_cast<std::size_t>(j) * static_cast<std::size_t>(image.width);
        return texel_at(image, index + static_cast<std::size_t>(i), leaf);
    };
    if (leaf.filter == TextureFilter::nearest)
        return texel(std::floor(x * image.width), std::floor(y * image.height));
    const double column = x * image.width - 0.5;
    const double row = y * image.height - 0.5;
    const double left = std::floor(column);
    const double below = std::floor(row);
    const auto mix = [](const Texel& a, const Texel& b, double t) {
        return per_channel([&](std::size_t c) { return a[c] + static_cast<float>(t) * (b[c] - a[c]); });
    };
    return mix(mix(texel(left, below), texel(left + 1, below), column - left),
               mix(texel(left, below + 1), texel(left + 1, below + 1), column - left), row - below);
}

/// Coordinates of a leaf from those of the grid of a formula.
class LeafMapping {
public:
    LeafMapping(const TextureMapping& grid, const TextureMapping& leaf) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double scale = grid.scale[axis];
            scale_[axis] = scale == 0 ? 0 : leaf.scale[axis] / scale;
            offset_[axis] = leaf.offset[axis] - scale_[axis] * static_cast<double>(grid.offset[axis]);
        }
    }
    std::array<double, 2> operator()(double x, double y) const {
        return {scale_[0] * x + offset_[0], scale_[1] * y + offset_[1]};
    }

private:
    std::array<double, 2> scale_ = {1, 1};
    std::array<double, 2> offset_ = {0, 0};
};

/// Evaluates a formula at points of its grid.
class Evaluation {
public:
    Evaluation(const TexturePlan& plan, const std::vector<Texture>& images, const std::vector<int>& formula,
               const TextureDomain& domain)
        : plan_(plan), images_(images), formula_(formula) {
        for (const int node : formula) {
            const TextureNode& leaf = plan.nodes[static_cast<std::size_t>(node)];
            mappings_.emplace_back(domain.mapping, leaf.mapping);
            const bool is_misfit =
                std::find(domain.misfits.begin(), domain.misfits.end(), node) != domain.misfits.end();
            is_misfit_.push_back(is_misfit);
            const bool needs_mean = is_misfit && leaf.operation == TextureOperation::image;
            means_.push_back(needs_mean ? mean_texel(image_of(leaf), leaf) : Texel{});
        }
    }

    Texel operator()(double x, double y) const {
        std::array<Texel, kMaxFormulaLength> values;
        for (std::size_t i = 0; i < formula_.size(); ++i) values[i] = step(i, values, x, y);
        return per_channel([&](std::size_t c) {
            // NaN becomes 0, too.
            const float value = values[formula_.size() - 1][c];
            return value > 0 ? std::min(value, std::numeric_limits<float>::max()) : 0.0f;
        });
    }

private:
    using Values = std::array<Texel, kMaxFormulaLength>;

    const Texture& image_of(const TextureNode& leaf) const {
        return images_[static_cast<std::size_t>(leaf.image)];
    }

    const Texel& operand(const TextureNode& node, std::size_t number, const Values& values) const {
        const auto place = std::lower_bound(formula_.begin(), formula_.end(), node.operands[number]);
        return values[static_cast<std::size_t>(place - formula_.begin())];
    }

    Texel step(std::size_t i, const Values& values, double x, double y) const {
        const TextureNode& node = plan_.nodes[static_cast<std::size_t>(formula_[i])];
        const auto a = [&](std::size_t c) { return operand(node, 0, values)[c]; };
        const auto b = [&](std::size_t c) { return operand(node, 1, values)[c]; };
        const auto [s, t] = mappings_[i](x, y);
        switch (node.operation) {
        case TextureOperation::constant:
            return node.constant;
        case TextureOperation::image:
            return is_misfit_[i] ? means_[i] : look_up(image_of(node), node, s, t);
        case TextureOperation::checkerboard: {
            if (is_misfit_[i]) return per_channel([&](std::size_t c) { return 0.5f * (a(c) + b(c)); });
            const bool is_odd = std::fmod(std::floor(s) + std::floor(t), 2.0) != 0;
            return operand(node, is_odd ? 1 : 0, values);
        }
        case TextureOperation::product:
            return per_channel([&](std::size_t c) { return a(c) * b(c); });
        case TextureOperation::mix: {
            const Texel& amount = operand(node, 2, values);
            return per_channel([&](std::size_t c) { return (1 - amount[c]) * a(c) + amount[c] * b(c); });
        }
        case TextureOperation::inversion:
            return per_channel([&](std::size_t c) { return std::max(0.0f, 1 - a(c)); });
        case TextureOperation::roughness:
            break;
        }
        return per_channel([&](std::size_t c) {
            const double roughness = std::max(0.0, static_cast<double>(a(c)));
            return roughness_from_alpha(alpha_from_roughness(roughness, node.rule));
        });
    }

    const TexturePlan& plan_;
    const std::vector<Texture>& images_;
    const std::vector<int>& formula_;
    std::vector<LeafMapping> mappings_; ///< per step
    std::vector<bool> is_misfit_;
    std::vector<Texel> means_;
};

/// A request with the parts of its formula.
struct Recipe {
    TextureRequest request;
    std::vector<int> formula;
    std::vector<int> images; ///< without repetitions
};

Recipe make_recipe(const TexturePlan& plan, const TextureRequest& request) {
    Recipe recipe{request, formula_nodes(plan.nodes, request.node), {}};
    if (recipe.formula.size() > kMaxFormulaLength)
        throw SceneError(request.location, "a texture consists of " + std::to_string(recipe.formula.size()) +
                                               " steps, but at most " + std::to_string(kMaxFormulaLength) +
                                               " are supported; bake it into one image");
    for (const int node : recipe.formula) {
        const int image = plan.nodes[static_cast<std::size_t>(node)].image;
        if (image >= 0 && std::find(recipe.images.begin(), recipe.images.end(), image) == recipe.images.end())
            recipe.images.push_back(image);
    }
    return recipe;
}

void charge(const Texture& texture, const Location& location, SceneBudget& budget) {
    try {
        budget.texels.take(static_cast<std::uint64_t>(texture.width) *
                           static_cast<std::uint64_t>(texture.height));
    } catch (const std::runtime_error& error) {
        throw SceneError(location, error.what());
    }
}

/// Turns an image into a texture; moves its texels if nothing else needs them.
/// \param use_count  how many textures need the image
Texture plain_image(const TextureNode& leaf, const TextureRequest& request, Texture& image,
                    std::size_t use_count, SceneBudget& budget) {
    const bool is_grey = request.channels == 1 || image.channels == 1;
    const int channels = is_grey ? 1 : 3;
    Texture texture;
    texture.name = image.name;
    texture.path = image.path;
    texture.width = image.width;
    texture.height = image.height;
    texture.channels = channels;
    texture.wrap = leaf.wrap;
    texture.filter = leaf.filter;
    if (image.channels == channels && use_count == 1) {
        texture.texels = std::move(image.texels);
        return texture;
    }
    charge(texture, request.location, budget);
    if (image.channels == channels) {
        texture.texels = image.texels;
        return texture;
    }
    const std::size_t count = image.texels.size() / static_cast<std::size_t>(image.channels);
    texture.texels.resize(count * static_cast<std::size_t>(channels));
    for (std::size_t i = 0; i < count; ++i) {
        const Texel texel = texel_at(image, i, leaf);
        if (is_grey)
            texture.texels[i] = mean(texel);
        else
            std::copy(texel.begin(), texel.end(),
                      texture.texels.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return texture;
}

void warn_of_losses(const Recipe& recipe, const TextureDomain& domain, Warnings& warnings) {
    if (!domain.misfits.empty())
        warnings.add(recipe.request.location, "texture misfits",
                     "a texture combines images with different wrap modes or with periods that do not divide "
                     "each other; images that do not fit the first one are replaced by their mean");
    if (domain.is_coarse)
        warnings.add(recipe.request.location, "texture resolution",
                     "a texture repeats an image too often within its period; its resolution is reduced to " +
                         std::to_string(domain.size[0]) + " x " + std::to_string(domain.size[1]));
}

BakedTexture bake(const TexturePlan& plan, const Recipe& recipe, const std::vector<Texture>& images,
                  SceneBudget& budget, Warnings& warnings) {
    std::vector<int> leaves;
    std::vector<std::array<int, 2>> sizes;
    for (const int number : recipe.formula) {
        const TextureNode& node = plan.nodes[static_cast<std::size_t>(number)];
        const bool is_image = node.operation == TextureOperation::image;
        if (!is_image && node.operation != TextureOperation::checkerboard) continue;
        leaves.push_back(number);
        const Texture* image = is_image ? &images[static_cast<std::size_t>(node.image)] : nullptr;
        sizes.push_back(is_image ? std::array{image->width, image->height} : std::array{1, 1});
    }
    const TextureDomain domain = find_domain(plan.nodes, leaves, sizes);
    warn_of_losses(recipe, domain, warnings);

    BakedTexture result;
    result.mapping = domain.mapping;
    Texture& texture = result.texture;
    texture.name =
        recipe.images.empty() ? "checkerboard" : images[static_cast<std::size_t>(recipe.images[0])].name;
    texture.width = domain.size[0];
    texture.height = domain.size[1];
    texture.channels = recipe.request.channels;
    // A roughness of 0 outside the image would be a perfect mirror.
    const bool is_roughness = std::any_of(recipe.formula.begin(), recipe.formula.end(), [&](int number) {
        return plan.nodes[static_cast<std::size_t>(number)].operation == TextureOperation::roughness;
    });
    const bool is_clamped = is_roughness && domain.wrap == TextureWrap::black;
    texture.wrap = is_clamped ? TextureWrap::clamp : domain.wrap;
    texture.filter = domain.filter;
    charge(texture, recipe.request.location, budget);
    const auto width = static_cast<std::size_t>(texture.width);
    const auto height = static_cast<std::size_t>(texture.height);
    const auto channels = static_cast<std::size_t>(texture.channels);
    texture.texels.resize(channels * width * height);
    const Evaluation evaluate(plan, images, recipe.formula, domain);
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        float* row = texture.texels.data() + channels * width * y;
        for (std::size_t x = 0; x < width; ++x) {
            const Texel texel = evaluate((static_cast<double>(x) + 0.5) / static_cast<double>(width),
                                         (static_cast<double>(y) + 0.5) / static_cast<double>(height));
            if (channels == 1)
                row[x] = mean(texel);
            else
                std::copy(texel.begin(), texel.end(), row + 3 * x);
        }
    });
    return result;
}

} // namespace

std::vector<BakedTexture> bake_textures(const TexturePlan& plan, SceneBudget& budget, Warnings& warnings) {
    std::vector<Recipe> recipes;
    std::vector<std::size_t> use_count(plan.images.size());
    for (const TextureRequest& request : plan.requests) {
        recipes.push_back(make_recipe(plan, request));
        for (const int image : recipes.back().images) ++use_count[static_cast<std::size_t>(image)];
    }
    std::vector<Warnings> image_warnings(plan.images.size());
    std::vector<Texture> images(plan.images.size());
    parallel_for_each_index(images.size(), [&](std::size_t i) {
        if (use_count[i] > 0) images[i] = decode_image(plan.images[i], budget, image_warnings[i]);
    });
    std::vector<Warnings> bake_warnings(recipes.size());
    std::vector<BakedTexture> textures(recipes.size());
    parallel_for_each_index(recipes.size(), [&](std::size_t i) {
        const Recipe& recipe = recipes[i];
        const TextureNode& root = plan.nodes[static_cast<std::size_t>(recipe.request.node)];
        if (root.operation == TextureOperation::image) {
            const auto image = static_cast<std::size_t>(root.image);
            textures[i] = {plain_image(root, recipe.request, images[image], use_count[image], budget),
                           root.mapping};
        } else {
            textures[i] = bake(plan, recipe, images, budget, bake_warnings[i]);
        }
    });
    for (const Warnings& some : image_warnings) warnings.append(some);
    for (const Warnings& some : bake_warnings) warnings.append(some);
    return textures;
}

} // namespace nusselt::scene
