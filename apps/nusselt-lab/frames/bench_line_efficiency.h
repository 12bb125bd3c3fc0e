#pragma once
/// `nusselt-lab bench line-efficiency SCENE`

#include "apps/common/line_options.h"

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchLineEfficiencyOptions {
    std::filesystem::path scene;
    std::optional<int> threads; ///< default: one, then all
    std::optional<std::string> resolution;
    std::optional<std::string> isa;
    std::string strategies = "diffuse";
    std::optional<float> roughness; ///< of all surfaces
    LineKindOptions lines;
    int most_points = 1024;
    int most_lines = 256;
    int repetitions = 5;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_line_efficiency() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_line_efficiency(CLI::App& bench, int& exit_code);

/// Measures the times in which line samples and point samples reach the same error.
int run_bench_line_efficiency(const BenchLineEfficiencyOptions& options);

} // namespace nusselt::app
