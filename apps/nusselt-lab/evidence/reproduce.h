#pragma once
/// `nusselt-lab reproduce`: the comparisons of the papers.

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
    int reference_samples = 0; ///< 0: as the experiments define
    int width = 0;             ///< of the images in pixels; 0: as the scenes define
    std::optional<int> threads;
};

/// Adds the subcommand. Its callback stores the result of run_reproduce() in exit_code, which must live until the
/// command line was parsed.
void setup_reproduce(CLI::App& app, int& exit_code);

/// Runs experiments, prints their tables and writes a page for each.
/// \returns 0, or 1 if an expectation does not hold
int run_reproduce(const ReproduceOptions& options);

} // namespace nusselt::app
