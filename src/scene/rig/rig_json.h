#pragma once
/// Reads files of light rigs, see docs/lights.md.

#include "scene/rig/rig.h"

#include <filesystem>
#include <string_view>

namespace nusselt::scene {

/// Reads a rig. Throws std::runtime_error with "file: path of the value: message" if the file cannot be read or does not
/// follow docs/lights.md.
Rig read_rig(const std::filesystem::path& path);

/// The same for the text of a file. \param path with which messages begin; files that the rig names are looked for beside it
Rig parse_rig(std::string_view text, const std::filesystem::path& path);

} // namespace nusselt::scene
