#pragma once
/// The metrics of `nusselt compare`: names, values, text and JSON.

#include "compare.h"

#include "image/metrics.h"

#include <nlohmann/json.hpp>

namespace nusselt::app {

/// One metric of one image.
struct MetricValue {
    std::string name; ///< in options, tables and JSON
    double value;
};

/// One image after the comparison.
struct ComparedImage {
    std::filesystem::path path;
    image::Comparison comparison;
    std::vector<MetricValue> metrics; ///< the chosen ones, in the order of metric_names()
};

/// A limit that an image does not keep.
struct BrokenLimit {
    std::string image;
    std::string metric;
    double value;
    double limit;
    std::string relation; ///< "above" or "below"; also for values that are NaN
};

/// All metrics.
[[nodiscard]] const std::vector<std::string>& metric_names();

/// The metrics that are printed by default: all but FLIP, which is slow for large images.
[[nodiscard]] const std::vector<std::string>& default_metric_names();

/// Computes the metrics that the options ask for, those with limits among them, and writes their pictures.
/// \throws std::runtime_error  if the sizes differ or a file cannot be written
[[nodiscard]] ComparedImage measure(const std::filesystem::path& path, const image::Image& a,
                                    const image::Image& reference, const CompareOptions& options);

[[nodiscard]] std::vector<BrokenLimit> broken_limits(const std::vector<ComparedImage>& images,
                                                     const CompareOptions& options);

/// Prints one image as a list, several as a table.
void print_metrics(const std::vector<ComparedImage>& images);

/// The schema is in the help of the command and in docs/images.md.
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<ComparedImage>& images,
                                             const std::vector<BrokenLimit>& broken,
                                             const image::Image& reference, const CompareOptions& options);

} // namespace nusselt::app
