#pragma once
/// The domain in which a formula of textures is evaluated.

#include "scene/build/textures/texture_formula.h"

#include <array>
#include <vector>

namespace nusselt::scene {

/// The grid of a baked texture.
struct TextureDomain {
    TextureMapping mapping; ///< from the coordinates of the surface to the unit square of the grid
    TextureWrap wrap = TextureWrap::repeat;
    TextureFilter filter = TextureFilter::nearest;
    std::array<int, 2> size = {1, 1};
    std::vector<int> misfits; ///< leaves that have no period in common with the others
    bool is_coarse = false;   ///< whether the resolution is too high and was reduced
};

/// Finds the grid of a formula.
/// \param leaves  nodes without operands that are not constant, and checkerboards, in the order of their numbers
/// \param sizes  of the images of the leaves in texels; {1, 1} for checkerboards
TextureDomain find_domain(const std::vector<TextureNode>& nodes, const std::vector<int>& leaves,
                          const std::vector<std::array<int, 2>>& sizes);

} // namespace nusselt::scene
