#pragma once

#include "scene/model/scene.h"

#include <string>

namespace nusselt::scene {

/// A hash of everything that images of a scene depend on: it changes with any vertex, texel, light or material, with the
/// camera and the film. Names and warnings do not count, because they may contain paths of files.
/// \returns 16 hexadecimal digits
std::string fingerprint(const Scene& scene);

} // namespace nusselt::scene
