#pragma once
/// `nusselt camera SCENE`, which prints the camera of a scene, and the option --camera of other commands.

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct CameraOptions {
    std::filesystem::path scene;
    std::optional<std::string> resolution;
};

/// Adds the subcommand. Its callback stores the result of run_camera() in exit_code, which must live until the
/// command line was parsed.
void setup_camera(CLI::App& app, int& exit_code);

/// Prints the camera of a scene.
/// \throws std::runtime_error if no image could have the size
int run_camera(const CameraOptions& options);

/// Adds --camera.
void add_camera_option(CLI::App& command, std::optional<std::filesystem::path>& camera);

} // namespace nusselt::app
