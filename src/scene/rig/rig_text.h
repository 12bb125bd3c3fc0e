#pragma once
/// Writes the lights of a scene as a rig.

#include "scene/model/scene.h"

#include <string>

namespace nusselt::scene {

/// The text of a rig that selects all lights of a scene and changes nothing. It gives the shape of lights that consist of one
/// part with a field in rigs, and the centroid of others; a radiance if all parts of a light share it.
std::string to_rig_text(const Scene& scene);

} // namespace nusselt::scene
