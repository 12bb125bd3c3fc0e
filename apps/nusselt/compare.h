#pragma once
/// `nusselt compare`: error metrics between two images.

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>

namespace nusselt::app {

struct CompareOptions {
    std::filesystem::path image;
    std::filesystem::path reference;
    std::optional<std::filesystem::path> difference; ///< where the false colour image goes
    std::optional<double> difference_scale;          ///< default: image::difference_scale()
    std::optional<std::filesystem::path> json; ///< "-" is the standard output, instead of the plain text
};

/// Adds the subcommand. Its callback stores the result of run_compare() in exit_code, which must live until
/// the command line was parsed.
void setup_compare(CLI::App& app, int& exit_code);

/// Prints the metrics and writes the files that are asked for.
/// \returns 0, or 1 after an error, which was printed to the standard error output in one line
int run_compare(const CompareOptions& options);

} // namespace nusselt::app
