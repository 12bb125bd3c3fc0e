#pragma once
/// The report of the kit for machines with a GPU: one JSON and one page in Markdown from the results of all steps.

#include <filesystem>
#include <string>

namespace nusselt::lab {

struct GpuReport {
    std::string json;
    std::string markdown;
    bool passes = false; ///< whether all steps ran and passed
};

/// Reads steps.txt in a folder, with a line "STEP OUTCOME SECONDS LOG" for each step, and the results STEP.json. The steps
/// are device, parity, agreement, samplers and frames; outcomes are passed, failed, late, stopped and not-run. A step that
/// passed without results has failed.
/// \param manifest file with lines "KEY: VALUE" on the program, which the report repeats; may be empty
/// \throws std::runtime_error if steps.txt or the manifest cannot be read, or has a wrong line
GpuReport report_on_gpu(const std::filesystem::path& folder, const std::filesystem::path& manifest);

} // namespace nusselt::lab
