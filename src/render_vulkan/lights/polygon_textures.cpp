#include "render_vulkan/lights/polygon_textures.h"

#include "render_vulkan/lights/emission_words.h"
#include "render_vulkan/record_values.h"
#include "scene/model/library_vector.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/texture_plane.h>
#include <nusselt/emission/textured_light_words.h>

#include <cstddef>
#include <span>

namespace nusselt::render_vulkan {

namespace {

/// \returns the number of the first word
std::uint32_t add_cells(const nusselt::TextureView<float>& view, std::span<const scene::Float2> coordinates,
                        int slots, std::vector<std::uint32_t>& words) {
    std::vector<Vec2<float>> outline;
    for (const scene::Float2& at : coordinates) outline.push_back({at.x, at.y});
    std::vector<float> storage(
        static_cast<std::size_t>(PyramidShape(kShaderCells, view.width, view.height).size));
    const ShaderLight light = make_textured_light<BilinearFilter, kShaderCells>(
        view, outline.data(), static_cast<int>(outline.size()), storage.data());
    const std::uint32_t first = grow_words(words, static_cast<std::size_t>(TexturedLightWords::count(light)));
    TexturedLightWords::write(light, slots, words.data() + first);
    return first;
}

} // namespace

interface::PolygonTextureRecord add_texture(const scene::Scene& scene, const scene::PolygonLight& light,
                                            int slots, std::vector<std::uint32_t>& words) {
    const scene::TexturedEmission& emission =
        scene.emission_textures.at(static_cast<std::size_t>(light.texture));
    const scene::EmissionTexture& texture = *emission.texture;
    const std::vector<Vec3<float>> texels =
        scene::scaled(texture.texels, scene::texel_scale(light, emission));
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
    record.first_texel = add_texels(texels, words);
    record.first_word = add_cells({texels.data(), texture.width, texture.height},
                                  std::span(emission.coordinates).first(light.vertices.size()), slots, words);
    return record;
}

} // namespace nusselt::render_vulkan
