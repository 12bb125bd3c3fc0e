#pragma once
/// The properties of imported scenes on which renderers rely.

#include "scene/model/scene.h"

#include <filesystem>
#include <string_view>

namespace nusselt::fuzz {

/// The first broken promise of scene/scene.h: arrays that belong together are equally long, indices are in range,
/// numbers finite, lights have 3 to 8 vertices, warnings one line. Empty if there is none.
std::string_view violation(const scene::Scene& scene);

/// Loads a scene, which may be refused with a std::runtime_error, on one thread: where it fails and which branches it
/// takes must not depend on the machine. Aborts with a message if the result breaks the contract.
void load_or_refuse(const std::filesystem::path& path);

} // namespace nusselt::fuzz
