#pragma once
/// `nusselt-lab bench samplers`

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchSamplersOptions {
    int repetitions = 31;
    std::optional<std::string> isa;
    bool compilers = false;          ///< also runs the programs of lab/timing/scalar
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_samplers() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_samplers(CLI::App& bench, int& exit_code);

/// Measures the cost of each technique and prints or writes the table.
int run_bench_samplers(const BenchSamplersOptions& options);

} // namespace nusselt::app
