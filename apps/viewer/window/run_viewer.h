#pragma once
/// The viewer in its window.

#include "viewer/viewer.h"

#include <filesystem>
#include <optional>

namespace nusselt::viewer {

/// Shows a window until the person or the script closes it.
/// \throws std::runtime_error if there is no display, a command of the script fails, or the device does
void run_viewer(Viewer& viewer, const std::optional<std::filesystem::path>& script);

} // namespace nusselt::viewer
