#pragma once
/// `nusselt camera SCENE`: the camera of a scene.

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
int run_camera(const CameraOptions& options);

} // namespace nusselt::app
