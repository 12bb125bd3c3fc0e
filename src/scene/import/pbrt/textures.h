#pragma once
/// Texture directives.

#include "scene/build/textures/texture_plan.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

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

/// The named textures of a scene, and the requests of materials for them.
class TextureTable {
public:
    /// Reduces a directive to a formula; docs/materials.md has the rules. Throws SceneError on impossible values.
    void define(TextureDirective& directive, Warnings& warnings);

    /// The texture of this name, preferably of this type. Throws SceneError at `location` if there is none.
    const TextureValue& value(const std::string& name, TextureType type, const Location& location) const;
    /// An image of numbers without any encoding, as normal maps are.
    TextureValue linear_image(const std::filesystem::path& path, const Location& location);

    TexturePlanner& planner() { return planner_; }
    TextureFormulas& formulas() { return planner_.formulas(); }

private:
    TextureValue reduce(TextureDirective& directive, Warnings& warnings);
    TextureValue reduce_image(TextureDirective& directive, Warnings& warnings);
    TextureValue reduce_scale(TextureDirective& directive, Warnings& warnings);
    TextureValue reduce_mix(TextureDirective& directive, const TextureValue& amount, Warnings& warnings);
    TextureValue reduce_checkerboard(TextureDirective& directive, Warnings& warnings);
    TextureValue reduce_procedure(TextureDirective& directive, Warnings& warnings);
    TextureValue input(TextureDirective& directive, std::string_view name, float fallback,
                       Warnings& warnings) const;

    std::map<std::pair<TextureType, std::string>, TextureValue> values_;
    TexturePlanner planner_;
};

} // namespace nusselt::scene
