#include "render_cpu/lights/polygon_textures.h"

#include "scene/model/library_vector.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/texture_plane.h>
#include <nusselt/emission/textured_light.h>

#include <cstddef>
#include <span>

namespace nusselt::render_cpu {

struct PolygonTextures::Prepared {
    Prepared(const scene::EmissionTexture& texture, const scene::Float3& scale,
             std::span<const scene::Float2> at)
        : texels(scene::scaled(texture.texels, scale)),
          storage(static_cast<std::size_t>(PyramidShape(kTextureCells, texture.width, texture.height).size)),
          light(make_light(texture, at)) {}

    TexturedLight<float, kTextureCells> make_light(const scene::EmissionTexture& texture,
                                                   std::span<const scene::Float2> at) {
        std::vector<Vec2<float>> outline;
        for (const scene::Float2& p : at) outline.push_back({p.x, p.y});
        const nusselt::TextureView<float> view{texels.data(), texture.width, texture.height};
        return make_textured_light<BilinearFilter, kTextureCells>(
            view, outline.data(), static_cast<int>(outline.size()), storage.data());
    }

    std::vector<Vec3<float>> texels;
    std::vector<float> storage;
    TexturedLight<float, kTextureCells> light;
};

PolygonTextures::PolygonTextures() = default;
PolygonTextures::~PolygonTextures() = default;

std::int32_t PolygonTextures::add(const scene::Scene& scene, const scene::PolygonLight& light) {
    const scene::TexturedEmission& emission =
        scene.emission_textures.at(static_cast<std::size_t>(light.texture));
    const std::span<const scene::Float2> at = std::span(emission.coordinates).first(light.vertices.size());
    prepared_.push_back(
        std::make_unique<Prepared>(*emission.texture, scene::texel_scale(light, emission), at));
    const Prepared& prepared = *prepared_.back();
    const scene::TexturePlacement placement = scene::place_texture(light, emission);
    PolygonTexture& record = records_.emplace_back();
    record.corner = placement.corner;
    record.side_x = placement.side_x;
    record.side_y = placement.side_y;
    record.normal =
        scene::to_float3(make_texture_plane(scene::to_vec(placement.corner), scene::to_vec(placement.side_x),
                                            scene::to_vec(placement.side_y))
                             .normal);
    record.radiance = reinterpret_cast<const scene::Float3*>(prepared.texels.data());
    record.width = emission.texture->width;
    record.height = emission.texture->height;
    record.inverse_mean = scene::per_channel_ratio({1, 1, 1}, light.radiance);
    record.cells = &prepared.light;
    return static_cast<std::int32_t>(records_.size() - 1);
}

} // namespace nusselt::render_cpu
