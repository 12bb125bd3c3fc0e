#pragma once
/// What the benchmarks of samplers have in common on the command line.

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>

namespace nusselt::app {

/// Adds --repetitions.
void add_repetitions_option(CLI::App& command, int& repetitions);

/// Adds --json.
void add_json_option(CLI::App& command, std::optional<std::string>& json);

/// Prints the table, and writes the JSON to the file, if one is named; or prints the JSON alone.
/// \param file as in --json: "-" is the standard output.
/// \throws std::runtime_error if the file cannot be written.
void write_results(const std::optional<std::string>& file, const std::string& json,
                   const std::function<void()>& print_table);

} // namespace nusselt::app
