#pragma once
/// How much memory a scene takes.

#include "scene/scene.h"

namespace nusselt::scene {

/// Bytes of all arrays of a scene, without what is allocated for growth.
std::size_t array_bytes(const Scene& scene);

} // namespace nusselt::scene
