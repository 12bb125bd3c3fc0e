#pragma once
/// Files with a camera and the size of its images; docs/rendering.md describes them.

#include "scene/model/scene.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace nusselt::scene {

/// A camera with the film that its raster positions refer to.
struct FilmedCamera {
    Camera camera;
    int width = 0;
    int height = 0;
};

/// {"version": 1, "film": [width, height], "camera": {...}}: `origin`, where rays through the upper left corner of the film
/// start [m], and `corner`, their direction; `right` and `down`, by how much that changes from one side of the film to the
/// other; for parallel rays `origin_right` and `origin_down`, by how much the origin does.
std::string to_camera_text(const FilmedCamera& view);

/// Throws std::runtime_error with "file: path of the value: message" if the file cannot be read or differs from this.
FilmedCamera read_camera_file(const std::filesystem::path& path);

/// The same for the text of a file. \param path with which messages begin
FilmedCamera parse_camera(std::string_view text, const std::filesystem::path& path);

/// Gives the scene this camera, and a film of this size without a crop.
void apply_camera(const FilmedCamera& view, Scene& scene);

} // namespace nusselt::scene
