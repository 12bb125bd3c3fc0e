#pragma once
/// Experiments with line samples that render one scene: N. Billen and P. Dutre 2016, Line Sampling for Direct Illumination,
/// Figures 2 and 3.

#include "lab/figures/image_comparison.h"

#include <vector>

namespace nusselt::lab {

std::vector<ImageComparison> line_comparisons();

} // namespace nusselt::lab
