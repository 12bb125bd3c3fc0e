#pragma once
/// `nusselt compare`: error metrics between images and a reference.

#include "image/flip.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::app {

/// A bound of one metric, see metric_names().
struct MetricLimit {
    std::string metric;
    double value = 0;
};

struct CompareOptions {
    std::vector<std::filesystem::path> images;
    std::filesystem::path reference;
    std::vector<std::string> metrics; ///< in any order
    double exposure = 0;              ///< stops, for metrics of displayed images
    double pixels_per_degree = image::kFlipPixelsPerDegree;
    std::vector<MetricLimit> at_most;
    std::vector<MetricLimit> at_least;
    std::optional<std::filesystem::path> difference; ///< where the signed false colour image goes
    std::optional<std::filesystem::path> absolute_difference;
    std::optional<double> difference_scale; ///< default: image::difference_scale()
    std::optional<std::filesystem::path> flip_map;
    std::optional<std::filesystem::path> hdr_flip_map;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the plain text
};

/// Adds the subcommand. Its callback stores the result of run_compare() in exit_code, which must live until
/// the command line was parsed.
void setup_compare(CLI::App& app, int& exit_code);

/// Prints the metrics and writes the files that are asked for. Pictures are of the first image.
/// \returns 0, or 3 if a limit is not kept, with a line for each on the standard error output
/// \throws std::runtime_error  if a file cannot be read or written or sizes differ
int run_compare(const CompareOptions& options);

} // namespace nusselt::app
