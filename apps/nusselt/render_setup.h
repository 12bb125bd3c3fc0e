#pragma once
/// Options that several commands share.

#include "render/settings.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::app {

/// Names of the values of an enumeration, see render/settings.h.
template <class Values>
std::vector<std::string> names_of(const Values& values) {
    std::vector<std::string> names;
    for (const auto value : values) names.emplace_back(name_of(value));
    return names;
}

inline std::string with_underscores(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

/// Replaces a name, with hyphens or underscores, by the name of a value; an error for all others.
template <class Values>
CLI::Validator to_name_of(const Values& values) {
    return CLI::IsMember(names_of(values), with_underscores);
}

/// The value of that name. \throws std::invalid_argument if there is none
template <class Values>
auto from_name(const Values& values, const std::string& name) {
    for (const auto value : values)
        if (name_of(value) == name) return value;
    throw std::invalid_argument("unknown setting '" + name + "'");
}

/// Adds --threads and --isa.
/// \param default_threads for the help: how many threads there are without the option
void add_machine_options(CLI::App& command, std::optional<int>& threads, std::optional<std::string>& isa,
                         const std::string& default_threads = "as many as the machine runs at once");

/// Adds --isa.
void add_isa_option(CLI::App& command, std::optional<std::string>& isa);

/// Adds --resolution.
void add_resolution_option(CLI::App& command, std::optional<std::string>& resolution);

/// Resizes the film as --resolution asks, if it is given.
void apply_resolution(const std::optional<std::string>& resolution, scene::Scene& scene);

inline constexpr const char* kAllLayers = "all";

/// Adds --layers. \param layers names of render::kLayerKinds, or kAllLayers
void add_layers_option(CLI::App& command, std::vector<std::string>& layers);

/// Adds --part.
void add_part_option(CLI::App& command, std::optional<std::string>& part);

/// From "2/3". \returns nothing if that is no part
std::optional<render::Part> parse_part(const std::string& text);

} // namespace nusselt::app
