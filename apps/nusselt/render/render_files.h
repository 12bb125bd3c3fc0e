#pragma once
/// The files that `nusselt render` writes.

#include "render.h"

#include "scene/model/scene.h"

#include <filesystem>
#include <vector>

namespace nusselt::app {

/// Images, as given or named after the film or the scene.
std::vector<std::filesystem::path> output_paths(const RenderOptions& options, const scene::Film& film);

/// The scene, the rigs and the camera.
std::vector<std::filesystem::path> input_paths(const RenderOptions& options);

/// \throws std::runtime_error if something could not be written after the work is done
void check_outputs(const RenderOptions& options);

/// \throws std::runtime_error if files would overwrite each other or what is read: files of the scene, rigs, the camera
void check_names(const RenderOptions& options, const scene::Scene& scene);

/// Names a file that was written on the standard output, unless that is for something else.
void print_output(const RenderOptions& options, const std::filesystem::path& path);

} // namespace nusselt::app
