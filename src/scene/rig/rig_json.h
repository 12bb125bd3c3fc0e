#pragma once
/// Files of light rigs, see docs/lights.md.

#include "scene/rig/rig.h"

#include <filesystem>

namespace nusselt::scene {

/// Reads a rig. Throws std::runtime_error, what() being "file: path of the value: message", if it cannot be read or if
/// anything in it does not follow docs/lights.md.
Rig read_rig(const std::filesystem::path& path);

} // namespace nusselt::scene
