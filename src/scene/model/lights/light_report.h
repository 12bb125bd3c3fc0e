#pragma once
/// Lights of a scene for people to read.

#include "scene/model/scene.h"

#include <string>

namespace nusselt::scene {

/// Lines of text: how many lights of each kind the scene has, then its emitters with their shape and power.
std::string light_report(const Scene& scene);

} // namespace nusselt::scene
