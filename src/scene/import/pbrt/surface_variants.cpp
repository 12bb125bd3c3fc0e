#include "scene/import/pbrt/surface_variants.h"

#include <algorithm>

namespace nusselt::scene {

namespace {

/// In pbrt v3 only meshes with normals replace the derivatives of the position; round shapes have normals here.
BumpUnit bump_unit(const ShapeDirective& shape, const Material& material) {
    const bool is_round = shape.type == "sphere" || shape.type == "disk" || shape.type == "cylinder";
    return is_round && material.bump_texture.texture >= 0 ? BumpUnit::metre : material.bump_unit;
}

} // namespace

int SurfaceVariants::material(int material, ShapeDirective& directive, TextureTable& textures,
                              std::vector<Material>& materials, Warnings& warnings) {
    ParameterList& shape = directive.parameters;
    if (shape.texture("shadowalpha") || shape.optional_real("shadowalpha"))
        warnings.add(shape.location_of("shadowalpha"), "shape shadowalpha",
                     "shadowalpha is ignored; shadows use the alpha of the surface");
    const Location location = shape.location_of("alpha");
    const auto name = shape.texture("alpha");
    const TextureValue value =
        name ? textures.value(*name, TextureType::number, location) : grey_value(shape.real("alpha", 1));
    const Material& own = materials[static_cast<std::size_t>(material)];
    Key key{material, std::clamp(value.factor.x, 0.0f, 1.0f), textures.planner().request(value, 1, location),
            bump_unit(directive, own)};
    if (key.alpha == 1 && key.texture < 0 && key.bump_unit == own.bump_unit) return material;
    const auto [entry, is_new] = variants_.try_emplace(key, static_cast<int>(materials.size()));
    if (!is_new) return entry->second;

    Material variant = own;
    variant.alpha *= key.alpha;
    variant.bump_unit = key.bump_unit;
    if (key.texture >= 0) {
        if (variant.alpha_texture.texture >= 0)
            warnings.add(location, "shape alpha over opacity",
                         "the alpha image of a shape replaces the opacity image of its material");
        variant.alpha_texture.texture = key.texture;
    }
    materials.push_back(std::move(variant));
    return entry->second;
}

} // namespace nusselt::scene
