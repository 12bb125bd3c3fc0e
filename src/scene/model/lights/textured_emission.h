#pragma once
/// Radiance that varies over a polygonal light, or along a tube or a line.

#include "scene/model/float3.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace nusselt::scene {

/// An image that lights emit, interpolated bilinearly between the centres of texels and constant beyond those at the edge.
/// Row 0 is the row at texture coordinate v = 0.
struct EmissionTexture {
    std::string name;
    int width = 0;              ///< from 1 to kMaxEmissionTextureSize
    int height = 0;             ///< from 1 to kMaxEmissionTextureSize
    std::vector<Float3> texels; ///< finite and not negative
    std::string path = {};      ///< of its file
};

inline constexpr int kMaxEmissionTextureSize = 1 << 14;

/// The texture of one light. At a texel t, the light has the radiance `radiance * t / mean`, per channel: its mean radiance is
/// the member `radiance` of PolygonLight or LineLight, whatever changes that. A channel that is black everywhere stays so.
struct TexturedEmission {
    std::shared_ptr<const EmissionTexture> texture;
    /// Of polygons, the texture coordinates of the vertices, in [0, 1]: an affine function of their positions.
    std::array<Float2, 8> coordinates = {};
    Float3 mean = {0, 0, 0}; ///< of the texture over the light; 0 in channels where it is below kDarkest
    /// The part of the image of the file that the texture shows: from `part_begin` to `part_end` in texture coordinates.
    Float2 part_begin = {0, 0}, part_end = {1, 1};
    Float3 largest = {0, 0, 0}; ///< of its texels, for each channel
};

struct PolygonLight;

/// Where the texture of a light lies: the affine map corner + u side_x + v side_y from texture coordinates to the world [m].
struct TexturePlacement {
    Float3 corner, side_x, side_y;
};
TexturePlacement place_texture(const PolygonLight& light, const TexturedEmission& emission);

/// The radiance of a texel of 1 [W/(sr m^2)].
Float3 texel_scale(const PolygonLight& light, const TexturedEmission& emission);

} // namespace nusselt::scene
