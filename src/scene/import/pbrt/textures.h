#pragma once
/// Texture directives.

#include "scene/build/texture_bake.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <compare>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nusselt::scene {

/// pbrt keeps textures of numbers and of colours apart, under names of their own.
enum class TextureType { number, colour };

struct TextureDirective {
    std::string name;
    TextureType type = TextureType::colour;
    std::string texture_class; ///< "imagemap", "scale", ...
    ParameterList parameters;
    std::filesystem::path image_path; ///< of the file that the parameter "filename" names
};

/// The named textures of a scene, and what materials ask of them.
class TextureTable {
public:
    /// Reduces a directive to a formula; docs/materials.md has the rules. Throws SceneError on impossible values.
    void define(TextureDirective& directive, Warnings& warnings);

    /// The texture of this name, preferably of this type. Throws SceneError at `location` if there is none.
    const TextureValue& value(const std::string& name, TextureType type, const Location& location) const;
    /// An image of numbers without any encoding, as normal maps are.
    TextureValue linear_image(const std::filesystem::path& path, const Location& location);

    TextureFormulas& formulas() { return formulas_; }

    /// Asks for the node of a value as a texture.
    /// \param channels  3 or 1
    /// \returns the index of the request; -1 for values without node
    int request(const TextureValue& value, int channels, const Location& location);
    /// All requests so far.
    TexturePlan plan() const { return {images_, formulas_.nodes(), requests_}; }

private:
    TextureValue reduce(TextureDirective& directive, Warnings& warnings);
    TextureValue reduce_image(TextureDirective& directive, Warnings& warnings);
    TextureValue reduce_scale(TextureDirective& directive, Warnings& warnings);
    TextureValue reduce_mix(TextureDirective& directive, const TextureValue& amount, Warnings& warnings);
    TextureValue reduce_checkerboard(TextureDirective& directive, Warnings& warnings);
    TextureValue reduce_procedure(TextureDirective& directive, Warnings& warnings);
    TextureValue input(TextureDirective& directive, std::string_view name, float fallback,
                       Warnings& warnings) const;
    int image_index(ImageRequest request);

    std::map<std::pair<TextureType, std::string>, TextureValue> values_;
    std::vector<ImageRequest> images_;
    std::map<std::pair<std::filesystem::path, ImageRequest::Encoding>, int> image_numbers_;
    std::vector<TextureRequest> requests_;
    std::map<std::pair<int, int>, int> request_numbers_; ///< of a node and a number of channels
    TextureFormulas formulas_;
};

} // namespace nusselt::scene
