#pragma once
/// Turns formulas of images into textures.

#include "scene/build/textures/texture_plan.h"

#include <vector>

namespace nusselt::scene {

struct BakedTexture {
    Texture texture;
    TextureMapping mapping; ///< from the coordinates of the surface to those of the texture
};

/// Decodes the images that requests need and evaluates their formulas, in parallel. A formula that is just an image
/// stays as it is. Others are evaluated once, at the texel centres of a new texture with the resolution of the finest
/// operand, over the common period of all operands; docs/materials.md has the rule and what happens where there is
/// none. Throws SceneError if an image cannot be read, a formula is too long or the texels exceed the budget.
/// \returns one texture per request
std::vector<BakedTexture> bake_textures(const TexturePlan& plan, SceneBudget& budget, Warnings& warnings);

} // namespace nusselt::scene
