#pragma once

#include "scene/model/scene.h"

#include <string>

namespace nusselt::scene {

/// A hash of everything that images of a scene depend on: another one where a vertex, texel, light, material, the camera
/// or the film differs. Names and warnings do not count, as they may hold the paths of files.
/// \returns 16 hexadecimal digits
std::string fingerprint(const Scene& scene);

} // namespace nusselt::scene
