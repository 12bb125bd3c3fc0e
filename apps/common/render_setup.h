#pragma once
/// Options that several commands share.

#include "render/names.h"
#include "render/settings.h"
#include "scene/model/scene.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::app {

using render::from_name;
using render::names_of;

/// Adds the argument SCENE.
void add_scene_argument(CLI::App& command, std::filesystem::path& scene);

/// Adds --threads.
/// \param default_threads for the help: how many threads there are without the option
void add_threads_option(CLI::App& command, std::optional<int>& threads,
                        const std::string& default_threads = "one per hardware thread");

/// Adds --threads and --isa.
void add_machine_options(CLI::App& command, std::optional<int>& threads, std::optional<std::string>& isa,
                         const std::string& default_threads = "one per hardware thread");

/// Adds --isa.
void add_isa_option(CLI::App& command, std::optional<std::string>& isa);

/// Adds --resolution.
void add_resolution_option(CLI::App& command, std::optional<std::string>& resolution);

/// Resizes the film to --resolution, if it is set.
void apply_resolution(const std::optional<std::string>& resolution, scene::Scene& scene);

inline constexpr const char* kAllLayers = "all";

/// Adds --layers. \param layers names of render::kLayerKinds, or kAllLayers
void add_layers_option(CLI::App& command, std::vector<std::string>& layers);

/// Adds --part.
void add_part_option(CLI::App& command, std::optional<std::string>& part);

/// Parses a part such as "2/3". \returns nothing if the text is invalid
std::optional<render::Part> parse_part(const std::string& text);

} // namespace nusselt::app
