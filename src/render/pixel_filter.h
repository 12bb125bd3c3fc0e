#pragma once
/// Pixel filters as distributions of camera rays.

#include "scene/model/scene.h"

#include <vector>

namespace nusselt::render {

/// A power of two.
inline constexpr int kFilterCells = 512;

/// A filter along one axis in kFilterCells cells of equal width: with the weights, expectations are those of a filter that
/// is constant in each cell and has the same integral there. Empty for boxes, whose rays are uniform.
struct PixelFilterTable {
    float reach = 0; ///< the cells extend from -reach to reach [pixels]
    std::vector<float>
        cumulative; ///< distribution of the absolute value at the ends of the cells, from 0 to 1
    std::vector<float>
        weights; ///< of the radiance in a cell: negative in the lobes of a Mitchell filter; mean 1
};

/// \param radius of the filter along the axis [pixels]
/// \throws std::runtime_error if the filter has no positive integral
PixelFilterTable make_filter_table(const scene::PixelFilter& filter, float radius);

} // namespace nusselt::render
