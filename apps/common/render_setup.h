#pragma once
/// Options that several commands share.

#include "render/names.h"
#include "render/settings.h"
#include "scene/model/scene.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::app {

using render::from_name;
using render::names_of;

inline std::string with_underscores(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

/// Replaces a name, with hyphens or underscores, by the name of a value; an error for all others.
template <class Values>
CLI::Validator to_name_of(const Values& values) {
    return CLI::IsMember(names_of(values), with_underscores);
}

/// Adds --threads and --isa.
/// \param default_threads for the help: how many threads there are without the option
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
