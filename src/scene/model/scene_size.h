#pragma once
/// The memory that a scene takes, and its limits.

#include "scene/model/scene.h"

#include <string_view>

namespace nusselt::scene {

/// Bytes of all arrays of a scene, without spare capacity.
std::size_t array_bytes(const Scene& scene);

/// Throws std::runtime_error if 32-bit indices cannot address that many vertices or triangles.
/// \param copies  what the user should use instead of many equal shapes, in the words of the format
void check_counts(std::size_t vertices, std::size_t triangles, std::string_view copies = "instances");

} // namespace nusselt::scene
