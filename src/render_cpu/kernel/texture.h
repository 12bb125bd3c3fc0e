#pragma once
/// Bilinear texture lookups.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The two texels next to a texture coordinate along one axis.
struct TexelPair {
    Indices first, second;
    Real weight; ///< of the second
};

inline TexelPair texel_pair(const Real& coordinate, std::int32_t size) noexcept {
    const Real count = Real(size);
    // Coordinates that overflowed in the scene file or in interpolation count as 0.
    const Real wrapped = select(is_finite(coordinate), coordinate - floor(coordinate), Real(0));
    const Real position = wrapped * count - Real(0.5f);
    const Real below = floor(position);
    const Real first = max(min(select(below < Real(0), count - Real(1), below), count - Real(1)), Real(0));
    const Real next = first + Real(1);
    const Real second = select(next < count, next, Real(0));
    float first_lanes[kLanes];
    float second_lanes[kLanes];
    first.store(first_lanes);
    second.store(second_lanes);
    TexelPair pair;
    for (int i = 0; i < kLanes; ++i) {
        pair.first.lane[i] = static_cast<std::int32_t>(first_lanes[i]);
        pair.second.lane[i] = static_cast<std::int32_t>(second_lanes[i]);
    }
    pair.weight = position - below;
    return pair;
}

inline Vector bilinear(const render_cpu::TextureView& texture, const Vec2<Real>& uv,
                       LaneMask active) noexcept {
    const TexelPair x = texel_pair(uv.x, texture.width);
    const TexelPair y = texel_pair(uv.y, texture.height);
    const auto texel = [&](const Indices& column, const Indices& row) {
        Indices index;
        for (int i = 0; i < kLanes; ++i) index.lane[i] = row.lane[i] * texture.width + column.lane[i];
        return gather_vector(texture.texels, 3, 0, index, active);
    };
    const auto mix = [](const Vector& a, const Vector& b, const Real& weight) {
        return a + weight * (b - a);
    };
    const Vector bottom = mix(texel(x.first, y.first), texel(x.second, y.first), x.weight);
    const Vector top = mix(texel(x.first, y.second), texel(x.second, y.second), x.weight);
    return mix(bottom, top, y.weight);
}

/// Looks up a texture per lane; white where the index is negative or the lane not active. Packets rarely see
/// more than one or two textures, so that a loop over textures costs little.
inline Vector look_up_textures(const render_cpu::TextureView* textures, const Indices& texture,
                               const Vec2<Real>& uv, LaneMask active) noexcept {
    Vector result{Real(1), Real(1), Real(1)};
    std::uint32_t remaining = 0;
    for (int i = 0; i < kLanes; ++i) remaining |= static_cast<std::uint32_t>(texture.lane[i] >= 0) << i;
    remaining &= active.bits();
    while (remaining != 0) {
        const std::int32_t current = texture.lane[__builtin_ctz(remaining)];
        std::uint32_t same = 0;
        for (int i = 0; i < kLanes; ++i) same |= static_cast<std::uint32_t>(texture.lane[i] == current) << i;
        same &= remaining;
        const LaneMask mask = LaneMask::from_bits(same);
        result = select(mask, bilinear(textures[current], uv, mask), result);
        remaining &= ~same;
    }
    return result;
}

} // namespace kernel
NUSSELT_NAMESPACE_END
