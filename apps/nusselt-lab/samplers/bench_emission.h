#pragma once
/// `nusselt-lab bench emission`

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchEmissionOptions {
    int repetitions = 101;
    std::optional<std::string> isa;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_emission() in exit_code, which must live until the command
/// line was parsed.
void setup_bench_emission(CLI::App& bench, int& exit_code);

/// Measures techniques for emission that varies and prints the table.
int run_bench_emission(const BenchEmissionOptions& options);

} // namespace nusselt::app
