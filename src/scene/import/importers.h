#pragma once
/// The door through which all scene files come: a table of formats. Another format is a folder beside pbrt, which turns a
/// file into a SceneDescription, and a row in the table.

#include "scene/build/scene_description.h"
#include "scene/model/scene.h"

#include <filesystem>
#include <span>
#include <string_view>

namespace nusselt::scene {

/// A format of scene files.
struct Importer {
    std::string_view name;
    std::string_view extension; ///< of its files, with the dot
    /// Reads a file and those that it includes. Throws SceneError, or std::runtime_error where no place in a file is to
    /// blame.
    SceneDescription (*read)(const std::filesystem::path& path);
    /// Whether a file with these contents may be of this format, for files with other extensions.
    bool (*recognizes)(std::string_view contents);
};

/// All formats.
std::span<const Importer> importers();

/// Loads a scene with its meshes and textures. The extension of the file determines its format, without ".gz" where it
/// is compressed; where no importer has that extension, the contents do.
///
/// The importer skips unknown input where that is safe, and reports it in Scene::warnings.
///
/// Throws std::runtime_error (SceneError of scene/input/diagnostics.h where a place in a file is to blame, what() being
/// "file:line: message") if the format is unknown, or a file cannot be read or contradicts its format.
Scene load_scene(const std::filesystem::path& path, std::span<const Importer> formats = importers());

} // namespace nusselt::scene
