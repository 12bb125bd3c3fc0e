#pragma once
/// How much memory a scene takes, and how large it may be.

#include "scene/model/scene.h"

#include <string_view>

namespace nusselt::scene {

/// Bytes of all arrays of a scene, without what is allocated for growth.
std::size_t array_bytes(const Scene& scene);

/// Throws std::runtime_error if a scene of so many vertices or triangles has more than the indices of 32 bits that are
/// used for them can tell apart.
/// \param copies  what the user should use instead of many equal shapes, in the words of the format
void check_counts(std::size_t vertices, std::size_t triangles, std::string_view copies = "instances");

} // namespace nusselt::scene
