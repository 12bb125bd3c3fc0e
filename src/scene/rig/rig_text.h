#pragma once
/// Printing of light rigs.

#include "scene/model/scene.h"

#include <string>

namespace nusselt::scene {

/// The lights of a scene as the text of a rig that changes nothing. Shapes are given for lights that consist of one
/// polygon or tube, the centroid for others; a radiance for lights all parts of which have the same.
std::string to_rig_text(const Scene& scene);

} // namespace nusselt::scene
