#pragma once
/// A report on the lights of a scene.

#include "scene/model/scene.h"

#include <string>

namespace nusselt::scene {

/// Lines of text: the number of lights of each kind, then the emitters with their shape and power.
std::string light_report(const Scene& scene);

} // namespace nusselt::scene
