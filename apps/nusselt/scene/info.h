#pragma once
/// `nusselt info SCENE`: what the importer makes of a scene file, or of an IES profile.

#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

namespace nusselt::app {

struct InfoOptions {
    std::filesystem::path scene;
    std::vector<std::filesystem::path> rigs;
};

/// Adds the subcommand. Its callback stores the result of run_info() in exit_code, which must live until the
/// command line was parsed.
void setup_info(CLI::App& app, int& exit_code);

/// Prints geometry, materials, textures, lights, camera, film, warnings and the time for loading to standard
/// output; for IES profiles, what run_profile_info() prints.
/// \throws CLI::ValidationError for rigs with a profile
/// \returns 0
int run_info(const InfoOptions& options);

} // namespace nusselt::app
