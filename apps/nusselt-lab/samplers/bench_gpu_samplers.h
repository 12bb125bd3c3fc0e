#pragma once
/// `nusselt-lab bench gpu-samplers`

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchGpuSamplersOptions {
    int repetitions = 15;
    std::optional<std::string> device; ///< index, or part of a name
    std::optional<std::string> json;   ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_gpu_samplers() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_gpu_samplers(CLI::App& bench, int& exit_code);

/// Measures the cost of each technique on a GPU and prints or writes the table.
int run_bench_gpu_samplers(const BenchGpuSamplersOptions& options);

} // namespace nusselt::app
