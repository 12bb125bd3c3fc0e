#pragma once
/// `nusselt-lab bench tubes`

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchTubesOptions {
    int repetitions = 31;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_tubes() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_tubes(CLI::App& bench, int& exit_code);

/// Measures noise and cost of sampling cylinders and prints the table.
int run_bench_tubes(const BenchTubesOptions& options);

} // namespace nusselt::app
