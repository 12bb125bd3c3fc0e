#pragma once
/// The entrance of the importer.

#include "scene/model/scene.h"

#include <filesystem>

namespace nusselt::scene {

/// Loads a pbrt scene, syntax v3 or v4, with its meshes and textures.
///
/// docs/materials.md says how materials, textures and lights are reduced. What the importer does not know it
/// skips where that is safe and says so in Scene::warnings.
///
/// Throws std::runtime_error (SceneError of scene/diagnostics.h where a line is to blame, what() being
/// "file:line: message") if a file cannot be read or contradicts the format.
Scene load_scene(const std::filesystem::path& path);

} // namespace nusselt::scene
