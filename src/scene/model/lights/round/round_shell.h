#pragma once
/// What the flat pieces that GPUs draw of round lights leave of their inside.

#include "scene/model/scene.h"

#include <vector>

namespace nusselt::scene {

/// For each round light the largest similar ellipsoid around its centre that fits into its triangles, as a share of the light: at
/// most 1. Ellipses and lights without triangles have 1.
std::vector<double> round_shells(const Scene& scene);

} // namespace nusselt::scene
