#pragma once
/// `nusselt info SCENE`: what the importer makes of a scene file.

#include <filesystem>

namespace CLI {
class App;
}

namespace nusselt::app {

struct InfoOptions {
    std::filesystem::path scene;
};

/// Adds the subcommand; its callback stores the exit code.
void setup_info(CLI::App& app, int& exit_code);

/// Prints geometry, materials, textures, lights, camera, film, warnings and the time for loading to standard
/// output. Returns the exit code of the process; throws what load_scene() throws.
int run_info(const InfoOptions& options);

} // namespace nusselt::app
