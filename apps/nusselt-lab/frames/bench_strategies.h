#pragma once
/// `nusselt-lab bench strategies SCENE`

#include "bench_frames.h"

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchStrategiesOptions : BenchFramesOptions {
    BenchStrategiesOptions() { repetitions = 15; }
};

/// Adds the subcommand. Its callback stores the result of run_bench_strategies() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_strategies(CLI::App& bench, int& exit_code);

/// Measures what a second technique for the specular component costs.
int run_bench_strategies(const BenchStrategiesOptions& options);

} // namespace nusselt::app
