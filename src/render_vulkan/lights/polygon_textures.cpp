#include "render_vulkan/lights/polygon_textures.h"

#include "render_vulkan/lights/emission_words.h"
#include "render_vulkan/record_values.h"
#include "scene/model/library_vector.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/texture_plane.h>
#include <nusselt/emission/textured_light_words.h>

#include <cstddef>
#include <span>
#include <utility>

namespace nusselt::render_vulkan {

const PolygonTextures::Texels& PolygonTextures::find_texels(const scene::EmissionTexture& texture,
                                                            const scene::Float3& scale) {
    const auto [known, is_new] = texels_.try_emplace({&texture, scale.x, scale.y, scale.z});
    Texels& texels = known->second;
    if (is_new) {
        texels.radiance = scene::scaled(texture.texels, scale);
        texels.first_word = add_texels(texels.radiance, words_);
    }
    return texels;
}

std::uint32_t PolygonTextures::find_cells(const scene::EmissionTexture& texture, const Texels& texels,
                                          const std::vector<Vec2<float>>& outline) {
    std::vector<float> numbers;
    for (const Vec2<float>& at : outline) numbers.insert(numbers.end(), {at.x, at.y});
    const auto [known, is_new] = cells_.try_emplace({&texels, std::move(numbers)});
    if (!is_new) return known->second;
    std::vector<float> storage(
        static_cast<std::size_t>(PyramidShape(kShaderCells, texture.width, texture.height).size));
    const nusselt::TextureView<float> view{texels.radiance.data(), texture.width, texture.height};
    const ShaderLight light = make_textured_light<BilinearFilter, kShaderCells>(
        view, outline.data(), static_cast<int>(outline.size()), storage.data());
    known->second = grow_words(words_, static_cast<std::size_t>(TexturedLightWords::count(light)));
    TexturedLightWords::write(light, slots_, words_.data() + known->second);
    return known->second;
}

interface::PolygonTextureRecord PolygonTextures::add(const scene::Scene& scene,
                                                     const scene::PolygonLight& light) {
    const scene::TexturedEmission& emission =
        scene.emission_textures.at(static_cast<std::size_t>(light.texture));
    const scene::EmissionTexture& texture = *emission.texture;
    const Texels& texels = find_texels(texture, scene::texel_scale(light, emission));
    const scene::TexturePlacement placement = scene::place_texture(light, emission);
    const auto plane = make_texture_plane(scene::to_vec(placement.corner), scene::to_vec(placement.side_x),
                                          scene::to_vec(placement.side_y));
    interface::PolygonTextureRecord record {};
    copy(placement.corner, record.corner);
    copy(placement.side_x, record.side_x);
    copy(placement.side_y, record.side_y);
    copy(scene::to_float3(plane.normal), record.normal);
    copy(scene::per_channel_ratio({1, 1, 1}, light.radiance), record.inverse_mean);
    record.width = texture.width;
    record.height = texture.height;
    record.first_texel = texels.first_word;
    std::vector<Vec2<float>> outline;
    for (const scene::Float2& at : std::span(emission.coordinates).first(light.vertices.size()))
        outline.push_back({at.x, at.y});
    record.first_word = find_cells(texture, texels, outline);
    return record;
}

} // namespace nusselt::render_vulkan
