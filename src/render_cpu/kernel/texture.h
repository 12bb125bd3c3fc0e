#pragma once
/// Looks up textures.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The two texels next to a texture coordinate along one axis.
struct TexelPair {
    Indices first, second;
    Real weight;   ///< weight of the second
    Real coverage; ///< share of both that lies within the texture
};

inline TexelPair texel_pair(const Real& coordinate, std::int32_t size,
                            const render_cpu::TextureView& texture) noexcept {
    const Real count = Real(size);
    const Real last = count - Real(1);
    // Coordinates that overflowed in the scene file or in interpolation count as 0.
    const Real sound = select(is_finite(coordinate), coordinate, Real(0));
    const bool repeats = texture.wrap == scene::TextureWrap::repeat;
    const Real scaled = (repeats ? sound - floor(sound) : sound) * count;
    const bool is_nearest = texture.filter == scene::TextureFilter::nearest;
    // More than one texel outside a texture that does not repeat, the result is constant.
    const Real position =
        max(min(is_nearest ? floor(scaled) : scaled - Real(0.5f), count + Real(1)), Real(-2));
    const Real below = floor(position);
    const Real next = below + Real(1);
    const Real first = repeats ? select(below < Real(0), last, below) : below;
    const Real second = repeats ? select(next < count, next, Real(0)) : next;
    float first_lanes[kLanes];
    float second_lanes[kLanes];
    max(min(first, last), Real(0)).store(first_lanes);
    max(min(second, last), Real(0)).store(second_lanes);
    TexelPair pair;
    for (int i = 0; i < kLanes; ++i) {
        pair.first.lane[i] = static_cast<std::int32_t>(first_lanes[i]);
        pair.second.lane[i] = static_cast<std::int32_t>(second_lanes[i]);
    }
    pair.weight = position - below;
    pair.coverage = max(min(min(position + Real(1), count - position), Real(1)), Real(0));
    return pair;
}

/// Looks up one texture in the lanes of a mask.
inline Vector look_up_texture(const render_cpu::TextureView& texture, const Vec2<Real>& uv,
                              LaneMask active) noexcept {
    const TexelPair x = texel_pair(uv.x, texture.width, texture);
    const TexelPair y = texel_pair(uv.y, texture.height, texture);
    const auto texel = [&](const Indices& column, const Indices& row) -> Vector {
        Indices index;
        for (int i = 0; i < kLanes; ++i) index.lane[i] = row.lane[i] * texture.width + column.lane[i];
        if (texture.channels == 3) return gather_vector(texture.texels, 3, 0, index, active);
        const Real grey = gather_column(texture.texels, 1, 0, index, active);
        return {grey, grey, grey};
    };
    const auto mix = [](const Vector& a, const Vector& b, const Real& weight) {
        return a + weight * (b - a);
    };
    const Vector bottom = mix(texel(x.first, y.first), texel(x.second, y.first), x.weight);
    const Vector top = mix(texel(x.first, y.second), texel(x.second, y.second), x.weight);
    const Vector value = mix(bottom, top, y.weight);
    return texture.wrap == scene::TextureWrap::black ? (x.coverage * y.coverage) * value : value;
}

/// Where each lane looks up the texture that its material has for one purpose.
struct TextureLanes {
    Indices texture; ///< -1 for none
    Vec2<Real> scale;
    Vec2<Real> coordinates; ///< scale * uv + offset
};

/// \param uv of the surface
inline TextureLanes texture_lanes(const render_cpu::KernelScene& scene, const Indices& material,
                                  scene::TextureUse render_cpu::MaterialTextures::*purpose,
                                  const Vec2<Real>& uv, LaneMask active) noexcept {
    constexpr int kStride = sizeof(render_cpu::MaterialTextures) / sizeof(float);
    const scene::TextureUse& first = scene.material_textures->*purpose;
    const auto word = [&](const float& entry) { return gather_column(&entry, kStride, 0, material, active); };
    TextureLanes lanes;
    for (int i = 0; i < kLanes; ++i)
        lanes.texture.lane[i] = (scene.material_textures[material.lane[i]].*purpose).texture;
    lanes.scale = {word(first.scale.x), word(first.scale.y)};
    lanes.coordinates = {lanes.scale.x * uv.x + word(first.offset.x),
                         lanes.scale.y * uv.y + word(first.offset.y)};
    return lanes;
}

/// Evaluates a function of texture and coordinates per lane. Lanes that are inactive or have no texture get
/// `otherwise`. A loop over textures costs little, because packets rarely have more than one or two.
template <class Function>
Vector look_up_textures(const render_cpu::TextureView* textures, const TextureLanes& lanes, LaneMask active,
                        const Vector& otherwise, const Function& function) noexcept {
    Vector result = otherwise;
    std::uint32_t remaining = 0;
    for (int i = 0; i < kLanes; ++i) remaining |= static_cast<std::uint32_t>(lanes.texture.lane[i] >= 0) << i;
    remaining &= active.bits();
    while (remaining != 0) {
        const std::int32_t current = lanes.texture.lane[__builtin_ctz(remaining)];
        std::uint32_t same = 0;
        for (int i = 0; i < kLanes; ++i)
            same |= static_cast<std::uint32_t>(lanes.texture.lane[i] == current) << i;
        same &= remaining;
        const LaneMask mask = LaneMask::from_bits(same);
        result = select(mask, function(textures[current], lanes.coordinates, mask), result);
        remaining &= ~same;
    }
    return result;
}

/// The derivatives of a height with respect to both texture coordinates, as differences over one texel. These have no
/// jumps, unlike the derivatives of bilinear textures.
inline Vec2<Real> height_derivatives(const render_cpu::TextureView& texture, const Vec2<Real>& coordinates,
                                     LaneMask active) noexcept {
    const Real width = Real(texture.width);
    const Real height = Real(texture.height);
    const auto at = [&](const Real& x, const Real& y) {
        return look_up_texture(texture, {coordinates.x + x, coordinates.y + y}, active).x;
    };
    const Real half_x = Real(0.5f) / width;
    const Real half_y = Real(0.5f) / height;
    const Real zero = Real(0);
    return {width * (at(half_x, zero) - at(-half_x, zero)), height * (at(zero, half_y) - at(zero, -half_y))};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
