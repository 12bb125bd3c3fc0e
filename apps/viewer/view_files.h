#pragma once
/// Files of the viewer: screenshots, cameras, light rigs, and the command that renders the same image.

#include "session.h"
#include "view_state.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::viewer {

/// The files with which the viewer started, and the rigs that it loaded since.
struct SceneFiles {
    std::filesystem::path scene;
    std::vector<std::filesystem::path> rigs; ///< in the order in which they are applied
    std::optional<std::string> device;       ///< as given by the user
    /// All files that were read, which no file that is saved may replace: also meshes, textures, the camera, the script.
    std::vector<std::filesystem::path> inputs;
};

/// Writes what is seen. A PNG file gets the picture of the window, without panels; other formats, see
/// image::write_image(), get the radiance of the left image, and NAME-right that of the right one if the screen is split.
/// Beside it go NAME.camera.json and, if lights were edited, NAME.lights.json, which the command needs.
/// \param session shows the state, see Session::finish()
/// \returns the command that renders the left image
/// \throws std::runtime_error if a file cannot be written or is one of the inputs, or its format is unknown
std::string write_screenshot(const std::filesystem::path& path, const Session& session,
                             const ViewState& state, const SceneFiles& files);

/// The names of files that go with a screenshot.
std::filesystem::path camera_file_of(const std::filesystem::path& screenshot);
std::filesystem::path lights_file_of(const std::filesystem::path& screenshot);

/// \throws std::runtime_error if the file cannot be written, or is one of the inputs
void save_camera(const std::filesystem::path& path, const Session& session, const ViewState& state,
                 const SceneFiles& files);
/// The film keeps its size; what is seen along the shorter side stays. \throws std::runtime_error if it cannot be read
void load_camera(const std::filesystem::path& path, const Session& session, ViewState& state);

/// Only the edits: the file is for use after the rigs that were loaded.
/// \throws std::runtime_error if the file cannot be written, or is one of the inputs
void save_lights(const std::filesystem::path& path, const Session& session, const ViewState& state,
                 const SceneFiles& files);

/// The command of the shell that renders an image of the session.
/// \param camera, lights files of save_camera() and save_lights(); no lights if none were edited
std::string command_of(const Session& session, const ViewState& state, const SceneFiles& files,
                       const std::filesystem::path& camera,
                       const std::optional<std::filesystem::path>& lights,
                       const std::filesystem::path& output);

} // namespace nusselt::viewer
