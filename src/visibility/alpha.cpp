#include "visibility/alpha.h"

#include <nusselt/random/pcg.h>
#include <nusselt/random/unit_interval.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace nusselt::visibility {

namespace {

/// A texture coordinate in texels. Where textures do not repeat, all coordinates far outside are alike.
float in_texels(float coordinate, int size, scene::TextureWrap wrap) {
    if (!std::isfinite(coordinate)) return 0;
    const float wrapped = wrap == scene::TextureWrap::repeat ? coordinate - std::floor(coordinate)
                                                             : std::clamp(coordinate, -1.0f, 2.0f);
    return wrapped * static_cast<float>(size);
}

/// The first channel of a texel, which may lie one texture's size outside.
float texel(const scene::Texture& texture, int x, int y) {
    const auto is_inside = [](int i, int size) { return i >= 0 && i < size; };
    switch (texture.wrap) {
    case scene::TextureWrap::repeat:
        x = (x + texture.width) % texture.width;
        y = (y + texture.height) % texture.height;
        break;
    case scene::TextureWrap::clamp:
        x = std::clamp(x, 0, texture.width - 1);
        y = std::clamp(y, 0, texture.height - 1);
        break;
    case scene::TextureWrap::black:
        if (!is_inside(x, texture.width) || !is_inside(y, texture.height)) return 0;
        break;
    }
    const auto index =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(x);
    return texture.texels[static_cast<std::size_t>(texture.channels) * index];
}

float look_up(const scene::Texture& texture, const scene::Float2& uv) {
    const float x = in_texels(uv.x, texture.width, texture.wrap);
    const float y = in_texels(uv.y, texture.height, texture.wrap);
    if (texture.filter == scene::TextureFilter::nearest)
        return texel(texture, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    const float left = std::floor(x - 0.5f);
    const float below = std::floor(y - 0.5f);
    const auto row = [&](int j) {
        const int i = static_cast<int>(left);
        return std::lerp(texel(texture, i, j), texel(texture, i + 1, j), x - 0.5f - left);
    };
    const int j = static_cast<int>(below);
    return std::lerp(row(j), row(j + 1), y - 0.5f - below);
}

} // namespace

Presence presence_of(const scene::Material& material) {
    if (!(material.alpha > 0)) return Presence::none;
    return material.alpha < 1 || material.alpha_texture.texture >= 0 ? Presence::partial : Presence::full;
}

float alpha_at(const scene::Scene& scene, std::uint32_t triangle, float u, float v) {
    const scene::Material& material = scene.materials[scene.triangle_material[triangle]];
    if (material.alpha_texture.texture < 0) return material.alpha;
    const auto& vertex = scene.triangles[triangle].vertex;
    const scene::Float2& a = scene.uvs[vertex[0]];
    const scene::Float2& b = scene.uvs[vertex[1]];
    const scene::Float2& c = scene.uvs[vertex[2]];
    return alpha_at(scene, material,
                    {a.x + u * (b.x - a.x) + v * (c.x - a.x), a.y + u * (b.y - a.y) + v * (c.y - a.y)});
}

float alpha_at(const scene::Scene& scene, const scene::Material& material, const scene::Float2& uv) {
    const scene::TextureUse& use = material.alpha_texture;
    if (use.texture < 0) return material.alpha;
    return material.alpha * look_up(scene.textures[static_cast<std::size_t>(use.texture)],
                                    {use.scale.x * uv.x + use.offset.x, use.scale.y * uv.y + use.offset.y});
}

float random_of_hit(const scene::Float3& origin, const scene::Float3& direction, std::uint32_t triangle,
                    std::uint32_t instance) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    const UInt4 place = pcg4d({bits(origin.x), bits(origin.y), bits(origin.z), triangle});
    const UInt4 way = {bits(direction.x), bits(direction.y), bits(direction.z), instance};
    return to_unit<float>(pcg4d({place.x ^ way.x, place.y ^ way.y, place.z ^ way.z, place.w ^ way.w}).x);
}

} // namespace nusselt::visibility
