#pragma once
/// Reduction of pbrt's materials to scene::Material. The formulas are listed in docs/materials.md.

#include "scene/import/pbrt/syntax/parameters.h"
#include "scene/import/pbrt/textures.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace nusselt::scene {

/// A Material or MakeNamedMaterial directive.
struct MaterialDirective {
    std::string name; ///< of the material; its type if it has none
    std::string type; ///< "matte", "coateddiffuse", ...
    ParameterList parameters;
    std::filesystem::path normal_map; ///< the file that the parameter "normalmap" names
};

/// The named material that others are mixed of; null if there is none of this name.
using FindMaterial = std::function<MaterialDirective*(const std::string& name)>;

/// Nothing if surfaces of this material are invisible. Textures of the result are indices of requests to `textures`.
/// Throws SceneError on parameters of impossible values or missing textures.
std::optional<Material> reduce_material(MaterialDirective& directive, TextureTable& textures,
                                        const FindMaterial& find_material, Warnings& warnings);

} // namespace nusselt::scene
