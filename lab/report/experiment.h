#pragma once
/// Everything that `nusselt-lab reproduce` can run.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <functional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Figures, tables or statements of the papers that are measured together.
struct Experiment {
    std::string name;        ///< on the command line and of folders
    std::string source;      ///< paper and figure
    std::string description; ///< one sentence
    /// \throws std::runtime_error if a scene cannot be loaded
    std::function<Report(const RunSettings& settings, const ProgressText& progress)> run;
    /// What this machine lacks to run it, such as another renderer, and how to get it; empty if nothing.
    std::function<std::string()> obstacle = [] { return std::string(); };
};

/// All experiments, in the order of the papers. A new kind of experiment is one more row in experiments.cpp.
const std::vector<Experiment>& all_experiments();

} // namespace nusselt::lab
