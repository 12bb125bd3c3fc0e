#include "render_cpu/lights/polygon_textures.h"

#include "scene/model/library_vector.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/texture_plane.h>
#include <nusselt/emission/textured_light.h>

#include <cstddef>
#include <span>
#include <utility>

namespace nusselt::render_cpu {

struct PolygonTextures::Prepared {
    Prepared(const scene::EmissionTexture& texture, const std::vector<Vec3<float>>& texels,
             std::span<const scene::Float2> at)
        : storage(static_cast<std::size_t>(PyramidShape(kTextureCells, texture.width, texture.height).size)),
          light(make_light({texels.data(), texture.width, texture.height}, at)) {}

    TexturedLight<float, kTextureCells> make_light(const nusselt::TextureView<float>& view,
                                                   std::span<const scene::Float2> at) {
        std::vector<Vec2<float>> outline;
        for (const scene::Float2& p : at) outline.push_back({p.x, p.y});
        return make_textured_light<BilinearFilter, kTextureCells>(
            view, outline.data(), static_cast<int>(outline.size()), storage.data());
    }

    std::vector<float> storage;
    TexturedLight<float, kTextureCells> light;
};

PolygonTextures::PolygonTextures() = default;
PolygonTextures::~PolygonTextures() = default;

std::int32_t PolygonTextures::add(const scene::Scene& scene, const scene::PolygonLight& light) {
    const scene::TexturedEmission& emission =
        scene.emission_textures.at(static_cast<std::size_t>(light.texture));
    const std::span<const scene::Float2> at = std::span(emission.coordinates).first(light.vertices.size());
    const scene::EmissionTexture& texture = *emission.texture;
    const scene::Float3 scale = scene::texel_scale(light, emission);
    const TexelKey texel_key{&texture, scale.x, scale.y, scale.z};
    auto texels = texels_.find(texel_key);
    if (texels == texels_.end())
        texels = texels_.emplace(texel_key, scene::scaled(texture.texels, scale)).first;
    std::vector<float> outline;
    for (const scene::Float2& p : at) outline.insert(outline.end(), {p.x, p.y});
    const Prepared& prepared =
        prepared_.try_emplace({&texels->second, std::move(outline)}, texture, texels->second, at)
            .first->second;
    const scene::TexturePlacement placement = scene::place_texture(light, emission);
    PolygonTexture& record = records_.emplace_back();
    record.corner = placement.corner;
    record.side_x = placement.side_x;
    record.side_y = placement.side_y;
    record.normal =
        scene::to_float3(make_texture_plane(scene::to_vec(placement.corner), scene::to_vec(placement.side_x),
                                            scene::to_vec(placement.side_y))
                             .normal);
    record.radiance = reinterpret_cast<const scene::Float3*>(texels->second.data());
    record.width = texture.width;
    record.height = texture.height;
    record.inverse_mean = scene::per_channel_ratio({1, 1, 1}, light.radiance);
    record.cells = &prepared.light;
    return static_cast<std::int32_t>(records_.size() - 1);
}

} // namespace nusselt::render_cpu
