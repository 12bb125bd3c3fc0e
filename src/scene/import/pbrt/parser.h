#pragma once
/// The importer of pbrt's scenes, syntax v3 or v4.

#include "scene/build/scene_description.h"

#include <filesystem>
#include <string_view>

namespace nusselt::scene {

/// Reads a scene file and what it includes. docs/materials.md describes how materials, textures and lights are reduced.
/// The importer skips unknown input where that is safe, with a warning. Throws SceneError, or
/// std::runtime_error if `path` cannot be read.
SceneDescription read_pbrt(const std::filesystem::path& path);

/// Whether a file that begins like this may be a scene: its first word begins with a capital letter.
bool looks_like_pbrt(std::string_view bytes);

} // namespace nusselt::scene
