#include "scene/alpha.h"

#include <algorithm>

namespace nusselt::scene {

int AlphaVariants::material(int material, ParameterList& shape, TextureTable& textures,
                            std::vector<Material>& materials, Warnings& warnings) {
    if (shape.texture("shadowalpha") || shape.optional_real("shadowalpha"))
        warnings.add(shape.location_of("shadowalpha"), "shape shadowalpha",
                     "shadowalpha is ignored, shadows have the alpha of the surface");
    const Location location = shape.location_of("alpha");
    const auto name = shape.texture("alpha");
    const TextureValue value =
        name ? textures.value(*name, TextureType::number, location) : grey_value(shape.real("alpha", 1));
    Key key{material, std::clamp(value.factor.x, 0.0f, 1.0f), textures.request(value, 1, location)};
    if (key.alpha == 1 && key.texture < 0) return material;
    const auto [entry, is_new] = variants_.try_emplace(key, static_cast<int>(materials.size()));
    if (!is_new) return entry->second;

    Material variant = materials[static_cast<std::size_t>(material)];
    variant.alpha *= key.alpha;
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
