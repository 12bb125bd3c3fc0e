#pragma once
/// Formulas of images as textures.

#include "scene/build/texture_formula.h"
#include "scene/build/texture_image.h"

#include <vector>

namespace nusselt::scene {

/// A texture that a material asks for.
struct TextureRequest {
    int node = -1;
    int channels = 3;  ///< 3, or 1 for the mean of the channels
    Location location; ///< of the material
};

/// All that the textures of a scene are made of.
struct TexturePlan {
    std::vector<ImageRequest> images;
    std::vector<TextureNode> nodes;
    std::vector<TextureRequest> requests;
};

struct BakedTexture {
    Texture texture;
    TextureMapping mapping; ///< of the coordinates of the surface to those of the texture
};

/// Decodes the images that requests need and evaluates their formulas, in parallel. A formula that is just an image
/// stays as it is. Others are evaluated once, at the texel centres of a new texture with the resolution of the finest
/// operand, over the common period of all operands; docs/materials.md has the rule and what happens where there is
/// none. Throws SceneError if an image cannot be read, a formula is too long or the texels exceed the budget.
/// \returns one texture per request
std::vector<BakedTexture> bake_textures(const TexturePlan& plan, SceneBudget& budget, Warnings& warnings);

} // namespace nusselt::scene
