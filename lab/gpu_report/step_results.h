#pragma once
/// The steps of the kit and their results.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

using Json = nlohmann::ordered_json;

struct GpuStep {
    std::string name, outcome;
    int seconds = 0;
    std::string log; ///< name of a file
};

/// What the steps left.
struct GpuSteps {
    std::vector<GpuStep> steps;
    std::map<std::string, Json> results; ///< by the name of the step; only those that could be read

    /// A truth value that the step `device` found; none if that is unknown.
    std::optional<bool> supports(const std::string& feature) const;
    /// Null if there is no such step.
    const GpuStep* find(const std::string& name) const;
};

/// \throws std::runtime_error see report_on_gpu()
GpuSteps read_steps(const std::filesystem::path& folder);

/// The lines "KEY: VALUE" of a file.
/// \throws std::runtime_error if the file cannot be read
std::vector<std::pair<std::string, std::string>> read_manifest(const std::filesystem::path& file);

/// The rows of a table of lab::Results as objects with a member for each column; none if there is no such table.
std::vector<Json> rows_of(const GpuSteps& steps, const std::string& step, const std::string& table);

} // namespace nusselt::lab
