#pragma once
/// Lights that are not uniform: C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, Figures 1 and 16 and Section 6.5.

#include "lab/figures/image_comparison.h"

#include <vector>

namespace nusselt::lab {

/// Their part of all_image_comparisons().
std::vector<ImageComparison> emission_comparisons();

} // namespace nusselt::lab
