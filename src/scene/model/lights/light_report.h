#pragma once
/// A report on the lights of a scene.

#include "scene/model/scene.h"

#include <iosfwd>

namespace nusselt::scene {

/// Writes lines of text: the number of lights of each kind, then the emitters with their shape and power. Takes no memory
/// for them, which for a million lights would be as much as the scene itself.
void write_light_report(const Scene& scene, std::ostream& stream);

} // namespace nusselt::scene
