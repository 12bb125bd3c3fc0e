#pragma once
/// `nusselt-lab reproduce`: the figures, tables and statements of the papers.

#include "lab/report/run_settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct ReproduceOptions {
    std::vector<std::string> experiments; ///< empty: all
    std::filesystem::path output = "out/reproduce";
    std::filesystem::path scenes = "scenes";
    lab::Effort effort = lab::Effort::quick;
    std::optional<int> threads;
};

/// Exit code if no expectation fails, but some could not be evaluated.
inline constexpr int kNotEvaluated = 3;

/// Adds the subcommand. Its callback stores the result of run_reproduce() in exit_code, which must live until the
/// command line was parsed.
void setup_reproduce(CLI::App& app, int& exit_code);

/// Runs experiments unless their reports are up to date, prints their tables and writes the page.
/// \returns 0, 1 if an expectation does not hold, or kNotEvaluated
int run_reproduce(const ReproduceOptions& options);

} // namespace nusselt::app
