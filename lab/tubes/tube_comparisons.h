#pragma once
/// Tubes, shaded as lines: E. Heitz, S. Hill 2017, Linear-Light Shading with Linearly Transformed Cosines.

#include "lab/figures/image_comparison.h"

#include <vector>

namespace nusselt::lab {

/// Their part of all_image_comparisons().
std::vector<ImageComparison> tube_comparisons();

} // namespace nusselt::lab
