#pragma once
/// Options and output that the commands that measure share.

#include "lab/results/results.h"
#include "scene/model/scene.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::app {

/// Adds --repetitions.
void add_repetitions_option(CLI::App& command, int& repetitions);

/// Adds --json.
void add_json_option(CLI::App& command, std::optional<std::string>& json);

/// Fails now, not after hours, if the file of --json cannot be written or is one of the files to read.
/// \throws std::runtime_error
void check_json_option(const std::optional<std::string>& file,
                       const std::vector<std::filesystem::path>& inputs = {});

/// Loads the scene to measure.
/// \param json as in --json
/// \throws std::runtime_error if the scene cannot be read or has no lights, or the results would replace one of its files
scene::Scene load_scene(const std::filesystem::path& path, const std::optional<std::string>& json);

/// Adds the argument SCENES and --scenes.
void add_scenes_options(CLI::App& command, std::vector<std::filesystem::path>& scenes,
                        std::filesystem::path& folder);

/// The scenes of a folder, and the bathroom where it is available.
/// \throws std::runtime_error if the folder does not exist
std::vector<std::filesystem::path> shipped_scenes(const std::filesystem::path& folder);

/// Prints the table, and writes the results to the file, if one is named; or prints them as JSON alone.
/// \param file as in --json: "-" is the standard output.
/// \throws std::runtime_error if the file cannot be written.
void write_results(const std::optional<std::string>& file, const lab::Results& results,
                   const std::function<void()>& print_table);

} // namespace nusselt::app
