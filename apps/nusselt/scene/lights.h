#pragma once
/// `nusselt lights SCENE`, and the option --lights of it and other commands.

#include "scene/model/scene.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace nusselt::app {

struct LightsOptions {
    std::filesystem::path scene;
    std::vector<std::filesystem::path> rigs;
};

/// Adds the subcommand. Its callback stores the result of run_lights() in exit_code, which must live until the
/// command line was parsed.
void setup_lights(CLI::App& app, int& exit_code);

/// Prints the lights of a scene as a rig.
/// \returns 0
int run_lights(const LightsOptions& options);

/// Adds --lights.
void add_rigs_option(CLI::App& command, std::vector<std::filesystem::path>& rigs);

/// Names of the files without their folders, separated by ", ".
std::string rig_names(const std::vector<std::filesystem::path>& rigs);

/// Loads a scene and applies the rigs of --lights in their order.
scene::Scene load_scene(const std::filesystem::path& path, const std::vector<std::filesystem::path>& rigs);

} // namespace nusselt::app
