#include "scene/build/textures/surface_formula.h"

namespace nusselt::scene {

Material make_material(const SurfaceFormula& surface, TexturePlanner& planner, const Location& origin) {
    const auto texture = [&](const TextureValue& value, int channels) {
        TextureUse use;
        use.texture = planner.request(value, channels, origin);
        return use;
    };
    const auto number = [](const TextureValue& value) { return static_cast<float>(mean(value.factor)); };
    Material material;
    material.model = surface.model;
    material.diffuse = surface.diffuse.factor;
    material.diffuse_texture = texture(surface.diffuse, 3);
    material.f0 = surface.f0.factor;
    material.f0_texture = texture(surface.f0, 3);
    material.roughness = number(surface.roughness);
    material.roughness_texture = texture(surface.roughness, 1);
    if (surface.model == BrdfModel::phong) material.exponent = static_cast<float>(surface.exponent);
    material.alpha = number(surface.alpha);
    material.alpha_texture = texture(surface.alpha, 1);
    material.bump = number(surface.bump);
    material.bump_texture = texture(surface.bump, 1);
    material.bump_unit = surface.bump_unit;
    material.normal_texture = texture(surface.normal, 3);
    return material;
}

Material black_material() {
    Material black;
    black.name = "black";
    black.diffuse = {0, 0, 0};
    return black;
}

} // namespace nusselt::scene
