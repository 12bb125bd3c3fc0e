#pragma once
/// More paths than a command line can have, in a file.

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::app {

/// Adds --list. \param what the paths name, such as "EXR files"
void add_list_option(CLI::App& command, std::optional<std::filesystem::path>& list, const std::string& what);

/// The paths of the command line, then those of the list.
/// \throws std::runtime_error if the list cannot be read, or there are no paths at all
std::vector<std::filesystem::path> with_listed(std::vector<std::filesystem::path> paths,
                                               const std::optional<std::filesystem::path>& list);

} // namespace nusselt::app
