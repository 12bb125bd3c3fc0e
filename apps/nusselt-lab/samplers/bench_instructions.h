#pragma once
/// `nusselt-lab bench instructions`

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchInstructionsOptions {
    std::optional<std::string> isa;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_instructions() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_instructions(CLI::App& bench, int& exit_code);

/// Counts the instructions of all techniques and prints the table.
/// \throws std::runtime_error on machines that cannot count
int run_bench_instructions(const BenchInstructionsOptions& options);

} // namespace nusselt::app
